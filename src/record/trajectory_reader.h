#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "src/geometry/pose.h"
#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// A stored instant.
struct StoredFrame {
    World world;
    std::vector<Pose> wall_poses;   ///< one per wall of the scene: takes rest points to where they were
    std::vector<Contact> contacts;  ///< as the engine reported them
};

/// Reads a trajectory.h5 that TrajectoryH5 wrote, frame by frame.
///
/// Errors: InputError names the file where it is absent, is no HDF5 file, not one of ours, or damaged; RunError where
/// it cannot be read on. Opening reads the head twice, at first in a process of its own (try_out).
class TrajectoryReader {
public:
    explicit TrajectoryReader(const std::filesystem::path& path);
    ~TrajectoryReader();
    TrajectoryReader(TrajectoryReader&&) noexcept;
    TrajectoryReader& operator=(TrajectoryReader&&) noexcept;

    const std::string& title() const;
    const std::string& source() const;
    const std::string& engine() const;
    const std::string& version() const;  ///< of the program that wrote the file
    double time_step() const;            ///< of the run [s]

    /// Shapes, materials, walls, gravity and grains as they were in the first frame: enough to draw and to measure,
    /// not to run on. Walls carry no motion (their places stand in each frame) and materials no pair laws.
    const Scene& scene() const;

    int frames() const;
    /// Of frame f of [0, frames()) [s].
    double time(int f) const;
    /// Frame f of [0, frames()).
    StoredFrame frame(int f) const;

private:
    class File;
    std::unique_ptr<File> file_;
};

}  // namespace polargrain
