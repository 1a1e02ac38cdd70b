#pragma once

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
    void sample(const Sample& sample) override;
    void end() override;

    int count() const { return count_; }

private:
    std::filesystem::path folder_;
    FrameSettings settings_;
    FrameStyle style_;
    std::optional<TextFile> index_;
    int count_ = 0;
};

}  // namespace polargrain
