#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "render/frame_style.h"
#include "src/record/text_file.h"
#include "src/run/sink.h"

namespace polargrain {

/// Draws the frames of a run into a folder: 000000.png, 000001.png, ..., and index.csv with file, time and step of
/// each. The folder is made where it is absent. Errors: RunError names the file.
class FramesSink : public Sink {
public:
    FramesSink(std::filesystem::path folder, FrameSettings settings);

    double every() const override { return settings_.every; }
    void begin(const Scene& scene, const RunInfo& info) override;
    void save(Checkpoint& checkpoint) override;
    void check(const Scene& scene, const Checkpoint& saved) const override;
    void resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) override;
    void sample(const Sample& sample) override;
    void end() override;

    std::int64_t count() const { return count_; }

private:
    /// Puts all that has been drawn on the disk.
    void sync();
    std::filesystem::path file_of(std::int64_t frame) const;

    std::filesystem::path folder_;
    FrameSettings settings_;
    FrameStyle style_;
    std::optional<TextFile> index_;
    std::int64_t count_ = 0;
    std::int64_t synced_ = 0;  ///< of them, on the disk for sure
};

}  // namespace polargrain
