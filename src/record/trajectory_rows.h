#pragma once

// Private to this folder: frames of trajectory.h5 as rows of its growing datasets.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "src/core/hash.h"
#include "src/model/checkpoint.h"

namespace polargrain {

/// One frame as it goes into the file; vectors are flat, x and y in turn.
struct FrameRows {
    std::int64_t step = 0;
    double time = 0.0;                                    ///< [s]
    std::vector<double> position, angle, velocity, spin;  ///< of all grains
    std::vector<double> wall_poses;                       ///< x, y, cosine, sine of each moving wall
    std::vector<std::int32_t> bodies;                     ///< two per contact
    std::vector<double> point, normal, gap, impulse;      ///< of all contacts

    std::int64_t contacts() const { return static_cast<std::int64_t>(gap.size()); }
    void add_to(StateHash& hash) const;
};

/// Reads frames back from the places in the file at which a checkpoint says they stand, past HDF5.
///
/// A kill in the midst of the library's own book-keeping can leave a file that it cannot open any more. Rows that were
/// on the disk before are not touched by it: chunks are neither moved nor compressed, and a chunk that is filled up is
/// written again with the same bytes in front.
class PlacedFrames {
public:
    /// saved: what TrajectoryH5::save has put there. InputError where the file is not there.
    PlacedFrames(const std::filesystem::path& path, const Checkpoint& saved, std::size_t grains,
                 std::size_t moving_walls);

    std::int64_t frames() const { return frames_; }
    /// The next frame, from the first on. InputError where the file ends too soon.
    FrameRows next();

private:
    template <typename T>
    std::vector<T> rows(const std::string& dataset, std::size_t row_length, std::int64_t first, std::int64_t count);

    std::filesystem::path path_;
    std::ifstream file_;
    Checkpoint places_;
    std::size_t grains_, moving_walls_;
    std::int64_t frames_;
    std::int64_t next_ = 0;
    std::int64_t next_contact_ = 0;
};

}  // namespace polargrain
