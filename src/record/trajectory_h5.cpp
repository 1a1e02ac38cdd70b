#include "src/record/trajectory_h5.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "src/core/error.h"
#include "src/record/h5.h"
#include "src/record/text_file.h"
#include "src/record/trajectory_head.h"
#include "src/record/trajectory_layout.h"
#include "src/record/trajectory_rows.h"

namespace polargrain {

namespace {

using h5::Growing;
using h5::Handle;

template <typename Job>
void naming_the_file(const std::filesystem::path& path, Job job) {
    try {
        job();
    } catch (const h5::Failure& failure) {
        throw RunError(fmt::format("{}: {}", path.string(), failure.what()));
    }
}

std::vector<double> paired(std::span<const double> x, std::span<const double> y) {
    std::vector<double> pairs(2 * x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
        pairs[2 * k] = x[k];
        pairs[2 * k + 1] = y[k];
    }
    return pairs;
}

/// The step and the time of each frame, shared by all that changes with time.
class Clock {
public:
    Clock() = default;
    explicit Clock(hid_t group) : step_(group, "step", {}), time_(group, "time", {}) { put_unit(time_.id(), "s"); }

    void append(const FrameRows& frame) {
        step_.append(std::span(&frame.step, 1));
        time_.append(std::span(&frame.time, 1));
    }
    void save_places(Checkpoint& places) {
        places.put("step", step_.chunk_places());
        places.put("time", time_.chunk_places());
    }
    void share_with(hid_t group) const {
        for (const auto& [dataset, name] : {std::pair{step_.id(), "step"}, std::pair{time_.id(), "time"}}) {
            h5::check(H5Lcreate_hard(dataset, ".", group, name, H5P_DEFAULT, H5P_DEFAULT), "share a clock");
        }
    }

private:
    Growing<std::int64_t> step_;
    Growing<double> time_;
};

/// An H5MD element that changes with time: value, step and time. The first one holds the clock.
Growing<double> time_dependent(hid_t parent, const char* name, const h5::Size& row, const char* unit, Clock& clock,
                               bool first = false) {
    const Handle group = h5::create_group(parent, name);
    if (first) {
        clock = Clock(group.id());
    } else {
        clock.share_with(group.id());
    }
    Growing<double> value(group.id(), "value", row);
    if (*unit != '\0') put_unit(value.id(), unit);
    return value;
}

/// Contacts of all frames one after the other, and where each frame's begin.
class Contacts {
public:
    Contacts(hid_t ours, const Clock& clock) : group_(h5::create_group(ours, layout::k_contacts)) {
        clock.share_with(group_.id());
        first_ = {group_.id(), "first", {}};
        count_ = {group_.id(), "count", {}};
        bodies_ = {group_.id(), "bodies", {2}};
        point_ = {group_.id(), "point", {2}};
        normal_ = {group_.id(), "normal", {2}};
        gap_ = {group_.id(), "gap", {}};
        impulse_ = {group_.id(), "impulse", {2}};
        put_unit(point_.id(), "m");
        put_unit(gap_.id(), "m");
        put_unit(impulse_.id(), "N s m-1");
    }

    void append(const FrameRows& frame) {
        bodies_.append(frame.bodies);
        point_.append(frame.point);
        normal_.append(frame.normal);
        gap_.append(frame.gap);
        impulse_.append(frame.impulse);
        const std::int64_t count = frame.contacts();
        first_.append(std::span(&total_, 1));
        count_.append(std::span(&count, 1));
        total_ += count;
    }
    void save_places(Checkpoint& places) {
        places.put("contacts", std::vector{total_});
        places.put("count", count_.chunk_places());
        places.put("bodies", bodies_.chunk_places());
        places.put("point", point_.chunk_places());
        places.put("normal", normal_.chunk_places());
        places.put("gap", gap_.chunk_places());
        places.put("impulse", impulse_.chunk_places());
    }

private:
    Handle group_;
    Growing<std::int64_t> first_, count_;
    Growing<std::int32_t> bodies_;
    Growing<double> point_, normal_, gap_, impulse_;
    std::int64_t total_ = 0;
};

}  // namespace

class TrajectoryH5::File {
public:
    File(const std::filesystem::path& path, const Provenance& provenance, const Scene& scene, const RunInfo& info)
        : file_(h5::create_file(path.string())) {
        put_provenance(file_.id(), provenance);
        const Handle particles = h5::create_group(file_.id(), "particles");
        const Handle grains = h5::create_group(particles.id(), layout::k_grains);
        put_box(grains.id());
        put_per_grain(grains.id(), scene.grains);
        const hsize_t n = scene.grains.x.size();
        position_ = time_dependent(grains.id(), "position", {n, 2}, "m", clock_, true);
        angle_ = time_dependent(grains.id(), "angle", {n}, "rad", clock_);
        velocity_ = time_dependent(grains.id(), "velocity", {n, 2}, "m s-1", clock_);
        spin_ = time_dependent(grains.id(), "spin", {n}, "rad s-1", clock_);
        const Handle ours = h5::create_group(file_.id(), layout::k_ours);
        put_problem(ours.id(), scene, info);
        put_shapes(ours.id(), scene);
        put_materials(ours.id(), scene.materials);
        begin_walls(ours.id(), scene);
        contacts_.emplace(ours.id(), clock_);
        whole_frames_ = h5::put_data<std::int64_t>(file_.id(), layout::k_frames, std::span(&frames_, 1), {});
        flush();
    }

    void append(const Sample& sample) { append(rows_of(sample)); }

    void append(const FrameRows& frame) {
        position_.append(frame.position);
        angle_.append(frame.angle);
        velocity_.append(frame.velocity);
        spin_.append(frame.spin);
        for (std::size_t w = 0; w < wall_poses_.size(); ++w) {
            wall_poses_[w].second.append(std::span(frame.wall_poses).subspan(4 * w, 4));
        }
        contacts_->append(frame);
        clock_.append(frame);
        flush();
        // A kill in the middle of a flush leaves the last rows in some of the datasets and not in others.
        ++frames_;
        h5::overwrite<std::int64_t>(whole_frames_, std::span(&frames_, 1));
        flush();
        frame.add_to(hash_);
    }

    /// How many frames there are, and where in the file they stand.
    void save(Checkpoint& checkpoint) {
        h5::sync(file_.id());
        checkpoint.put("frames", std::vector{frames_});
        checkpoint.put("hash", std::vector{static_cast<std::int64_t>(hash_.value())});
        Checkpoint places;
        clock_.save_places(places);
        places.put("position", position_.chunk_places());
        places.put("angle", angle_.chunk_places());
        places.put("velocity", velocity_.chunk_places());
        places.put("spin", spin_.chunk_places());
        for (std::size_t w = 0; w < wall_poses_.size(); ++w) {
            places.put(fmt::format("wall{}", w), wall_poses_[w].second.chunk_places());
        }
        contacts_->save_places(places);
        checkpoint.put_part(layout::k_places, places);
    }

    std::uint64_t hash() const { return hash_.value(); }
    std::size_t moving_walls() const { return wall_poses_.size(); }

    /// With all that the library has kept back; afterwards there is nothing that could be appended to.
    void close() {
        flush();
        // The library closes a file in earnest when the last thing in it is closed, and tells only that call.
        contacts_.reset();
        whole_frames_.reset();
        wall_poses_.clear();
        for (Growing<double>* growing : {&position_, &angle_, &velocity_, &spin_}) *growing = {};
        clock_ = {};
        file_.close("close the file");
    }

private:
    void flush() { h5::check(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "write the file"); }

    void begin_walls(hid_t ours, const Scene& scene) {
        const Handle walls = h5::create_group(ours, layout::k_walls);
        LinkNames names;
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            const Wall& wall = scene.walls[w];
            const Handle group = put_wall(walls.id(), wall, names.of(wall.name, w), w);
            if (wall.moves()) wall_poses_.emplace_back(w, time_dependent(group.id(), "pose", {4}, "", clock_));
        }
    }

    FrameRows rows_of(const Sample& sample) const {
        FrameRows frame;
        const Grains& grains = sample.world.grains;
        frame.step = sample.world.step;
        frame.time = sample.world.time;
        frame.position = paired(grains.x, grains.y);
        frame.angle = grains.angle;
        frame.velocity = paired(grains.vx, grains.vy);
        frame.spin = grains.spin;
        for (const auto& entry : wall_poses_) {
            const Pose now = wall_state(sample.scene.walls[entry.first], sample.world.time).pose;
            frame.wall_poses.insert(frame.wall_poses.end(), {now.centre.x(), now.centre.y(), now.cosine, now.sine});
        }
        for (const Contact& contact : sample.report.contacts) {
            frame.bodies.insert(frame.bodies.end(), {contact.a, contact.b});
            frame.point.insert(frame.point.end(), {contact.point.x(), contact.point.y()});
            frame.normal.insert(frame.normal.end(), {contact.normal.x(), contact.normal.y()});
            frame.gap.push_back(contact.gap);
            frame.impulse.insert(frame.impulse.end(), {contact.impulse.x(), contact.impulse.y()});
        }
        return frame;
    }

    Handle file_;  // first in, last out: it closes after everything in it
    Clock clock_;
    Growing<double> position_, angle_, velocity_, spin_;
    std::vector<std::pair<std::size_t, Growing<double>>> wall_poses_;  // of moving walls
    std::optional<Contacts> contacts_;
    std::int64_t frames_ = 0;
    Handle whole_frames_;  // the dataset that holds frames_
    StateHash hash_;       // of all frames
};

TrajectoryH5::TrajectoryH5(std::filesystem::path path, double every, Provenance provenance)
    : path_(std::move(path)), every_(every), provenance_(std::move(provenance)) {}

TrajectoryH5::~TrajectoryH5() = default;

void TrajectoryH5::begin(const Scene& scene, const RunInfo& info) {
    naming_the_file(path_, [&] { file_ = std::make_unique<File>(path_, provenance_, scene, info); });
}

void TrajectoryH5::save(Checkpoint& checkpoint) {
    naming_the_file(path_, [&] { file_->save(checkpoint); });
}

void TrajectoryH5::check(const Scene& scene, const Checkpoint& saved) const {
    const auto moving = std::ranges::count_if(scene.walls, [](const Wall& wall) { return wall.moves(); });
    PlacedFrames frames(path_, saved, scene.grains.x.size(), static_cast<std::size_t>(moving));
    StateHash hash;
    for (std::int64_t f = 0; f < frames.frames(); ++f) frames.next().add_to(hash);
    require_same(hash.value(), saved);
}

void TrajectoryH5::require_same(std::uint64_t hash, const Checkpoint& saved) const {
    require(static_cast<std::int64_t>(hash) == saved.integers("hash").at(0),
            "{}: is not the file that the checkpoint was made with; it has been changed since", path_.string());
}

void TrajectoryH5::resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) {
    std::filesystem::path part = path_;
    part += ".part";
    naming_the_file(part, [&] {
        file_ = std::make_unique<File>(part, provenance_, scene, info);
        PlacedFrames frames(path_, saved, scene.grains.x.size(), file_->moving_walls());
        for (std::int64_t f = 0; f < frames.frames(); ++f) file_->append(frames.next());
    });
    require_same(file_->hash(), saved);
    put_in_place(part, path_);
}

void TrajectoryH5::sample(const Sample& sample) {
    naming_the_file(path_, [&] { file_->append(sample); });
}

void TrajectoryH5::end() {
    naming_the_file(path_, [&] { file_->close(); });
    file_.reset();
    sync_file(path_);
}

}  // namespace polargrain
