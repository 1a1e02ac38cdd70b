#include "src/record/trajectory_h5.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "src/core/error.h"
#include "src/record/h5.h"
#include "src/record/trajectory_layout.h"

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

std::vector<double> flat(std::span<const Vec2> points) {
    std::vector<double> numbers;
    numbers.reserve(2 * points.size());
    for (const Vec2& p : points) numbers.insert(numbers.end(), {p.x(), p.y()});
    return numbers;
}

/// Names as HDF5 can hold them, each once: a slash would open a group, and equal names would collide.
class LinkNames {
public:
    std::string of(std::string name, std::size_t index) {
        std::replace(name.begin(), name.end(), '/', '_');
        if (name.empty() || name == ".") name = "_";
        if (!taken_.insert(name).second) {
            name += fmt::format("#{}", index);
            taken_.insert(name);
        }
        return name;
    }

private:
    std::set<std::string> taken_;
};

void put_unit(hid_t object, const char* unit) { h5::put_text(object, "unit", unit); }

void put_points(hid_t group, const char* name, std::span<const Vec2> points) {
    put_unit(h5::put_data<double>(group, name, flat(points), {points.size(), 2}).id(), "m");
}

/// The step and the time of each frame, shared by all that changes with time.
class Clock {
public:
    Clock() = default;
    explicit Clock(hid_t group) : step_(group, "step", {}), time_(group, "time", {}) { put_unit(time_.id(), "s"); }

    void append(const World& world) {
        step_.append(std::span(&world.step, 1));
        time_.append(std::span(&world.time, 1));
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

void put_provenance(hid_t file, const Provenance& provenance) {
    const Handle h5md = h5::create_group(file, "h5md");
    h5::put_numbers<std::int32_t>(h5md.id(), "version", std::vector<std::int32_t>{1, 1});
    const Handle author = h5::create_group(h5md.id(), "author");
    h5::put_text(author.id(), "name", provenance.author);
    const Handle creator = h5::create_group(h5md.id(), "creator");
    h5::put_text(creator.id(), "name", "polargrain");
    h5::put_text(creator.id(), "version", provenance.version);
    h5::put_text(creator.id(), "build", provenance.build);
    const Handle modules = h5::create_group(h5md.id(), "modules");
    const Handle units = h5::create_group(modules.id(), "units");
    h5::put_numbers<std::int32_t>(units.id(), "version", std::vector<std::int32_t>{1, 0});
    h5::put_text(units.id(), "system", "SI");
}

void put_problem(hid_t ours, const Scene& scene, const RunInfo& info) {
    h5::put_number<std::int32_t>(ours, "layout_version", layout::k_version);
    h5::put_text(ours, "title", info.title);
    h5::put_text(ours, "source", info.source);
    h5::put_text(ours, "engine", info.engine);
    h5::put_number<double>(ours, "time_step", info.dt);
    h5::put_number<double>(ours, "duration", info.duration);
    h5::put_number<std::int64_t>(ours, "seed", static_cast<std::int64_t>(scene.seed));
    h5::put_numbers<double>(ours, "gravity", flat(std::span(&scene.gravity, 1)));
}

void put_outline(hid_t group, const Disk& disk) { h5::put_number<double>(group, "radius", disk.radius()); }

void put_outline(hid_t group, const PolarPolygon& polygon) { put_points(group, "vertices", polygon.vertices()); }

void put_shapes(hid_t ours, const Scene& scene) {
    const Handle shapes = h5::create_group(ours, layout::k_shapes);
    LinkNames names;
    for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
        const Shape& shape = *scene.shapes[s];
        const Handle group = h5::create_group(shapes.id(), names.of(name(shape), s));
        h5::put_text(group.id(), "name", name(shape));
        h5::put_number<std::int32_t>(group.id(), "index", static_cast<std::int32_t>(s));
        h5::put_number<double>(group.id(), "area", area(shape));
        h5::put_number<double>(group.id(), "polar_moment", polar_moment(shape));
        std::visit([&group](const auto& outline) { put_outline(group.id(), outline); }, shape);
    }
}

void put_materials(hid_t ours, const Materials& materials) {
    const Handle all = h5::create_group(ours, layout::k_materials);
    LinkNames names;
    for (MaterialIndex m = 0; m < materials.size(); ++m) {
        const Material& material = materials[m];
        const Handle group = h5::create_group(all.id(), names.of(material.name, static_cast<std::size_t>(m)));
        h5::put_text(group.id(), "name", material.name);
        h5::put_number<std::int32_t>(group.id(), "index", m);
        h5::put_number<double>(group.id(), "density", material.density);
        h5::put_number<double>(group.id(), "friction", material.friction);
        h5::put_number<double>(group.id(), "restitution_mean", material.restitution.mean);
        h5::put_number<double>(group.id(), "restitution_stddev", material.restitution.stddev);
    }
}

Handle put_wall(hid_t walls, const Wall& wall, const std::string& link, std::size_t index) {
    Handle group = h5::create_group(walls, link);
    h5::put_text(group.id(), "name", wall.name);
    h5::put_number<std::int32_t>(group.id(), "index", static_cast<std::int32_t>(index));
    h5::put_number<std::int32_t>(group.id(), "material", wall.material);
    if (wall.remove_at) h5::put_number<double>(group.id(), "remove_at", *wall.remove_at);
    put_points(group.id(), "points", wall.points);
    return group;
}

void put_per_grain(hid_t group, const Grains& grains) {
    const h5::Size all{grains.x.size()};
    put_unit(h5::put_data<double>(group, "mass", grains.mass, all).id(), "kg m-1");
    put_unit(h5::put_data<double>(group, "inertia", grains.inertia, all).id(), "kg m");
    h5::put_data<std::int32_t>(group, "shape", grains.shape, all);
    h5::put_data<std::int32_t>(group, "material", grains.material, all);
}

/// H5MD wants to know how space is bounded: not at all.
void put_box(hid_t group) {
    const Handle box = h5::create_group(group, "box");
    h5::put_number<std::int32_t>(box.id(), "dimension", 2);
    h5::put_texts(box.id(), "boundary", {"none", "none"});
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

    void append(std::span<const Contact> contacts) {
        std::vector<std::int32_t> bodies;
        std::vector<double> gaps;
        std::vector<Vec2> points, normals, impulses;
        for (const Contact& contact : contacts) {
            bodies.insert(bodies.end(), {contact.a, contact.b});
            points.push_back(contact.point);
            normals.push_back(contact.normal);
            gaps.push_back(contact.gap);
            impulses.push_back(contact.impulse);
        }
        bodies_.append(bodies);
        point_.append(flat(points));
        normal_.append(flat(normals));
        gap_.append(gaps);
        impulse_.append(flat(impulses));
        const auto count = static_cast<std::int64_t>(contacts.size());
        first_.append(std::span(&total_, 1));
        count_.append(std::span(&count, 1));
        total_ += count;
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
        flush();
    }

    void append(const Sample& sample) {
        const Grains& grains = sample.world.grains;
        append_pairs(position_, grains.x, grains.y);
        angle_.append(grains.angle);
        append_pairs(velocity_, grains.vx, grains.vy);
        spin_.append(grains.spin);
        for (auto& [wall, pose] : wall_poses_) {
            const Pose now = wall_state(sample.scene.walls[wall], sample.world.time).pose;
            pose.append(std::vector<double>{now.centre.x(), now.centre.y(), now.cosine, now.sine});
        }
        contacts_->append(sample.report.contacts);
        clock_.append(sample.world);
        flush();
    }

    void flush() { h5::check(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "write the file"); }

private:
    void begin_walls(hid_t ours, const Scene& scene) {
        const Handle walls = h5::create_group(ours, layout::k_walls);
        LinkNames names;
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            const Wall& wall = scene.walls[w];
            const Handle group = put_wall(walls.id(), wall, names.of(wall.name, w), w);
            if (wall.moves()) wall_poses_.emplace_back(w, time_dependent(group.id(), "pose", {4}, "", clock_));
        }
    }

    void append_pairs(Growing<double>& dataset, std::span<const double> x, std::span<const double> y) {
        buffer_.resize(2 * x.size());
        for (std::size_t k = 0; k < x.size(); ++k) {
            buffer_[2 * k] = x[k];
            buffer_[2 * k + 1] = y[k];
        }
        dataset.append(buffer_);
    }

    Handle file_;  // first in, last out: it closes after everything in it
    Clock clock_;
    Growing<double> position_, angle_, velocity_, spin_;
    std::vector<std::pair<std::size_t, Growing<double>>> wall_poses_;  // of moving walls
    std::optional<Contacts> contacts_;
    std::vector<double> buffer_;  // one frame
};

TrajectoryH5::TrajectoryH5(std::filesystem::path path, double every, Provenance provenance)
    : path_(std::move(path)), every_(every), provenance_(std::move(provenance)) {}

TrajectoryH5::~TrajectoryH5() = default;

void TrajectoryH5::begin(const Scene& scene, const RunInfo& info) {
    naming_the_file(path_, [&] { file_ = std::make_unique<File>(path_, provenance_, scene, info); });
}

void TrajectoryH5::sample(const Sample& sample) {
    naming_the_file(path_, [&] { file_->append(sample); });
}

void TrajectoryH5::end() {
    naming_the_file(path_, [&] { file_->flush(); });
    file_.reset();
}

}  // namespace polargrain
