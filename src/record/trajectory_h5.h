#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "src/record/provenance.h"
#include "src/run/sink.h"

namespace polargrain {

/// Writes trajectory.h5 in H5MD 1.1 (de Buyl, Colberg & Hoefling 2014): a frame of poses, velocities and contacts at
/// each sample; docs/run-folder.md gives the layout.
///
/// Doubles are stored with all their bits; equal runs write equal bytes, and so does a run that is resumed: it writes
/// the file anew beside the old one, from the rows that the checkpoint knows of. Each frame is flushed. A kill between
/// two flushes leaves a readable file; one in a flush may not, but resuming mends it. Memory: one frame. Errors:
/// RunError names the file.
class TrajectoryH5 : public Sink {
public:
    /// every: interval between frames [s]. The file is created in begin().
    TrajectoryH5(std::filesystem::path path, double every, Provenance provenance);
    ~TrajectoryH5() override;

    double every() const override { return every_; }
    void begin(const Scene& scene, const RunInfo& info) override;
    void save(Checkpoint& checkpoint) override;
    void check(const Scene& scene, const Checkpoint& saved) const override;
    void resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) override;
    void sample(const Sample& sample) override;
    void end() override;

private:
    class File;
    void require_same(std::uint64_t hash, const Checkpoint& saved) const;

    std::filesystem::path path_;
    double every_;
    Provenance provenance_;
    std::unique_ptr<File> file_;
};

}  // namespace polargrain
