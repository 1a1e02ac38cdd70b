#include "src/record/trajectory_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "src/core/error.h"
#include "src/record/h5.h"
#include "src/record/trajectory_layout.h"

namespace polargrain {

void FrameRows::add_to(StateHash& hash) const {
    hash.add(step);
    hash.add(std::span(&time, 1));
    for (const auto* values : {&position, &angle, &velocity, &spin, &wall_poses, &point, &normal, &gap, &impulse}) {
        hash.add(*values);
    }
    for (const std::int32_t body : bodies) hash.add(std::int64_t{body});
}

PlacedFrames::PlacedFrames(const std::filesystem::path& path, const Checkpoint& saved, std::size_t grains,
                           std::size_t moving_walls)
    : path_(path),
      file_(path, std::ios::binary),
      places_(saved.part(layout::k_places)),
      grains_(grains),
      moving_walls_(moving_walls),
      frames_(saved.integers("frames").at(0)) {
    require(file_.good(), "{}: cannot be read, but the checkpoint was made with it", path.string());
}

template <typename T>
std::vector<T> PlacedFrames::rows(const std::string& dataset, std::size_t row_length, std::int64_t first,
                                  std::int64_t count) {
    std::vector<T> values(static_cast<std::size_t>(count) * row_length);
    if (values.empty()) return values;
    const auto in_chunk = static_cast<std::int64_t>(h5::rows_per_chunk<T>(row_length));
    const auto row_bytes = static_cast<std::int64_t>(row_length * sizeof(T));
    const std::vector<std::int64_t>& chunks = places_.integers(dataset);
    char* into = reinterpret_cast<char*>(values.data());
    for (std::int64_t row = first; row < first + count;) {
        const std::int64_t within = row % in_chunk;
        const std::int64_t run = std::min(in_chunk - within, first + count - row);
        file_.seekg(chunks.at(static_cast<std::size_t>(row / in_chunk)) + within * row_bytes);
        file_.read(into, run * row_bytes);
        require(file_.good(), "{}: is shorter than when the checkpoint was made; it has been changed since",
                path_.string());
        into += run * row_bytes;
        row += run;
    }
    return values;
}

FrameRows PlacedFrames::next() {
    FrameRows frame;
    frame.step = rows<std::int64_t>("step", 1, next_, 1).at(0);
    frame.time = rows<double>("time", 1, next_, 1).at(0);
    frame.position = rows<double>("position", 2 * grains_, next_, 1);
    frame.angle = rows<double>("angle", grains_, next_, 1);
    frame.velocity = rows<double>("velocity", 2 * grains_, next_, 1);
    frame.spin = rows<double>("spin", grains_, next_, 1);
    for (std::size_t w = 0; w < moving_walls_; ++w) {
        const std::vector<double> pose = rows<double>(fmt::format("wall{}", w), 4, next_, 1);
        frame.wall_poses.insert(frame.wall_poses.end(), pose.begin(), pose.end());
    }
    const std::int64_t count = rows<std::int64_t>("count", 1, next_, 1).at(0);
    // A number that no checkpoint vouches for yet: the hash over all frames is compared at the end.
    require(count >= 0 && next_contact_ + count <= places_.integers("contacts").at(0),
            "{}: has been changed since the checkpoint was made", path_.string());
    frame.bodies = rows<std::int32_t>("bodies", 2, next_contact_, count);
    frame.point = rows<double>("point", 2, next_contact_, count);
    frame.normal = rows<double>("normal", 2, next_contact_, count);
    frame.gap = rows<double>("gap", 1, next_contact_, count);
    frame.impulse = rows<double>("impulse", 2, next_contact_, count);
    next_ += 1;
    next_contact_ += count;
    return frame;
}

}  // namespace polargrain
