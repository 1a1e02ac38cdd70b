#include "src/record/trajectory_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/core/error.h"
#include "src/core/trial.h"
#include "src/record/h5.h"
#include "src/record/text_file.h"
#include "src/record/trajectory_checks.h"
#include "src/record/trajectory_layout.h"

namespace polargrain {

namespace {

using h5::Handle;

std::vector<Vec2> paired(std::span<const double> numbers) {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) points.emplace_back(numbers[k], numbers[k + 1]);
    return points;
}

/// The groups of a folder in the order of their attribute `index`.
std::vector<Handle> by_index(hid_t file, const char* folder) {
    const Handle group = h5::open_group(file, folder);
    const std::vector<std::string> names = h5::names_in(group.id());
    std::vector<Handle> ordered(names.size());
    for (const std::string& name : names) {
        Handle entry = h5::open_group(group.id(), name);
        const auto index = static_cast<std::size_t>(h5::number<std::int32_t>(entry.id(), "index"));
        expect_whole(index < ordered.size() && ordered[index].id() < 0,
                     fmt::format("the entries of {} are not numbered through", folder));
        ordered[index] = std::move(entry);
    }
    return ordered;
}

Shape read_shape(hid_t group) {
    std::string name = h5::text(group, "name");
    if (h5::has_attribute(group, "radius")) return Disk(std::move(name), h5::number<double>(group, "radius"));
    MassProperties mass;
    mass.area = h5::number<double>(group, "area");
    mass.polar_moment = h5::number<double>(group, "polar_moment");
    return PolarPolygon(std::move(name), paired(h5::data<double>(group, "vertices")), mass);
}

Material read_material(hid_t group) {
    return {h5::text(group, "name"),
            h5::number<double>(group, "density"),
            {h5::number<double>(group, "restitution_mean"), h5::number<double>(group, "restitution_stddev")},
            h5::number<double>(group, "friction")};
}

Wall read_wall(hid_t group) {
    Wall wall;
    wall.name = h5::text(group, "name");
    wall.material = h5::number<std::int32_t>(group, "material");
    wall.points = paired(h5::data<double>(group, "points"));
    if (h5::has_attribute(group, "remove_at")) wall.remove_at = h5::number<double>(group, "remove_at");
    return wall;
}

/// Of processor time, for reading the head: many times what it takes.
unsigned seconds_for(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
    return ignored ? 1 : 2 + static_cast<unsigned>(std::min<std::uintmax_t>(bytes / 1'000'000, 1000));
}

constexpr const char* k_remedy = "run its scenario.toml again, or resume the run where it was not brought to its end";

std::string path_in(const char* folder, const char* name) { return fmt::format("{}/{}", folder, name); }

}  // namespace

class TrajectoryReader::File {
public:
    explicit File(const std::filesystem::path& from) : path(from), file_(h5::open_file(from.string())) {
        const Handle ours = h5::open_group(file_.id(), layout::k_ours);
        const auto version = h5::number<std::int32_t>(ours.id(), "layout_version");
        if (version != layout::k_version) {
            throw h5::Failure(fmt::format("layout version {}, this program reads {}", version, layout::k_version));
        }
        title = h5::text(ours.id(), "title");
        source = h5::text(ours.id(), "source");
        engine = h5::text(ours.id(), "engine");
        time_step = h5::number<double>(ours.id(), "time_step");
        const Handle creator = h5::open_group(file_.id(), "/h5md/creator");
        writer_version = h5::text(creator.id(), "version");
        read_scene(ours.id());
        times = read_times();
        frames = static_cast<int>(times.size());
        if (frames == 0) return;
        scene.grains = read_frame(0).world.grains;
        for (const auto* values : {&scene.grains.x, &scene.grains.y, &scene.grains.vx, &scene.grains.vy}) {
            expect_numbers(*values, "a position or velocity of the first frame");
        }
    }

    StoredFrame read_frame(int f) const {
        StoredFrame frame;
        const auto row = static_cast<hsize_t>(f);
        frame.world.time = row_of<double>(layout::k_grains, "position/time", row).at(0);
        frame.world.step = row_of<std::int64_t>(layout::k_grains, "position/step", row).at(0);
        frame.world.grains = grains_at(row);
        for (std::size_t w = 0; w < walls_.size(); ++w) frame.wall_poses.push_back(wall_pose(w, row));
        frame.contacts = contacts_at(row);
        return frame;
    }

    std::filesystem::path path;
    std::string title, source, engine, writer_version;
    double time_step = 0.0;
    Scene scene;
    std::vector<double> times;  // [s] of each frame
    int frames = 0;

private:
    template <typename T>
    std::vector<T> row_of(const char* folder, const char* name, hsize_t row) const {
        return h5::rows<T>(file_.id(), path_in(folder, name), row, 1);
    }

    /// Of the frames that are whole: a run that was killed may have left more rows in some datasets.
    std::vector<double> read_times() const {
        const std::string dataset = path_in(layout::k_grains, "position/time");
        if (H5Lexists(file_.id(), layout::k_frames, H5P_DEFAULT) <= 0) return h5::data<double>(file_.id(), dataset);
        const std::int64_t whole = h5::data<std::int64_t>(file_.id(), layout::k_frames).at(0);
        expect_whole(whole >= 0, "it has a negative number of frames");
        return h5::rows<double>(file_.id(), dataset, 0, static_cast<hsize_t>(whole));
    }

    void read_scene(hid_t ours) {
        const std::vector<double> gravity = h5::numbers<double>(ours, "gravity");
        expect_whole(gravity.size() == 2, "gravity has not two components");
        scene.gravity = {gravity[0], gravity[1]};
        scene.seed = static_cast<std::uint64_t>(h5::number<std::int64_t>(ours, "seed"));
        for (const Handle& group : by_index(file_.id(), layout::k_shapes)) {
            scene.add(std::make_shared<const Shape>(read_shape(group.id())));
        }
        for (const Handle& group : by_index(file_.id(), layout::k_materials)) {
            scene.materials.add(read_material(group.id()));
        }
        walls_ = by_index(file_.id(), layout::k_walls);
        for (const Handle& group : walls_) scene.walls.push_back(read_wall(group.id()));
        Grains& grains = scene.grains;
        grains.mass = h5::data<double>(file_.id(), path_in(layout::k_grains, "mass"));
        grains.inertia = h5::data<double>(file_.id(), path_in(layout::k_grains, "inertia"));
        grains.shape = h5::data<std::int32_t>(file_.id(), path_in(layout::k_grains, "shape"));
        grains.material = h5::data<std::int32_t>(file_.id(), path_in(layout::k_grains, "material"));
        expect_whole(scene);
    }

    Grains grains_at(hsize_t row) const {
        Grains grains = scene.grains;
        const std::vector<Vec2> positions = paired(row_of<double>(layout::k_grains, "position/value", row));
        const std::vector<Vec2> velocities = paired(row_of<double>(layout::k_grains, "velocity/value", row));
        for (auto* values : {&grains.x, &grains.y, &grains.vx, &grains.vy}) values->resize(positions.size());
        for (GrainIndex k = 0; k < static_cast<GrainIndex>(positions.size()); ++k) {
            grains.set_position(k, positions[Grains::at(k)]);
            grains.set_velocity(k, velocities[Grains::at(k)]);
        }
        grains.angle = row_of<double>(layout::k_grains, "angle/value", row);
        grains.spin = row_of<double>(layout::k_grains, "spin/value", row);
        const std::size_t n = grains.mass.size();
        expect_whole(
            positions.size() == n && velocities.size() == n && grains.angle.size() == n && grains.spin.size() == n,
            "it has not as many positions, angles, velocities and spins as grains");
        return grains;
    }

    Pose wall_pose(std::size_t w, hsize_t row) const {
        const hid_t group = walls_[w].id();
        if (H5Lexists(group, "pose", H5P_DEFAULT) <= 0) return {};
        const std::vector<double> pose = h5::rows<double>(group, "pose/value", row, 1);
        expect_whole(pose.size() == 4, fmt::format("the pose of wall {} has not four numbers", w));
        expect_numbers(pose, fmt::format("the pose of wall {}", w));
        return {{pose[0], pose[1]}, pose[2], pose[3]};
    }

    std::vector<Contact> contacts_at(hsize_t row) const {
        const auto first = static_cast<hsize_t>(row_of<std::int64_t>(layout::k_contacts, "first", row).at(0));
        const auto count = static_cast<hsize_t>(row_of<std::int64_t>(layout::k_contacts, "count", row).at(0));
        const auto column = [&](const char* name) {
            return h5::rows<double>(file_.id(), path_in(layout::k_contacts, name), first, count);
        };
        const auto bodies = h5::rows<std::int32_t>(file_.id(), path_in(layout::k_contacts, "bodies"), first, count);
        const std::vector<double> gaps = column("gap");
        const std::vector<Vec2> points = paired(column("point"));
        const std::vector<Vec2> normals = paired(column("normal"));
        const std::vector<Vec2> impulses = paired(column("impulse"));
        expect_whole(bodies.size() == 2 * count && gaps.size() == count && points.size() == count &&
                         normals.size() == count && impulses.size() == count,
                     "its contacts have not two bodies, a point, a normal, a gap and an impulse each");
        std::vector<Contact> contacts;
        for (std::size_t c = 0; c < count; ++c) {
            contacts.push_back({bodies[2 * c], bodies[2 * c + 1], points[c], normals[c], gaps[c], impulses[c]});
            expect_whole(contacts.back(), scene);
        }
        return contacts;
    }

    Handle file_;
    std::vector<Handle> walls_;
};

TrajectoryReader::TrajectoryReader(const std::filesystem::path& path) {
    require(std::filesystem::exists(path), "{}: no such file; a run writes it unless [output] trajectory is 0",
            path.string());
    require_readable(path);
    const std::string bad = path.string() + ": is damaged, or not a trajectory that polargrain wrote";
    // HDF5 trusts the lengths of texts that it reads. The head holds all of them.
    const Trial trial = try_out([&path] { File{path}; }, seconds_for(path));
    require(trial != Trial::crashed, "{}: reading it crashes; {}", bad, k_remedy);
    require(trial != Trial::too_long, "{}: reading it finds no end; {}", bad, k_remedy);
    try {
        file_ = std::make_unique<File>(path);
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: {}; {}", bad, error.what(), k_remedy));
    }
}

TrajectoryReader::~TrajectoryReader() = default;
TrajectoryReader::TrajectoryReader(TrajectoryReader&&) noexcept = default;
TrajectoryReader& TrajectoryReader::operator=(TrajectoryReader&&) noexcept = default;

const std::string& TrajectoryReader::title() const { return file_->title; }
const std::string& TrajectoryReader::source() const { return file_->source; }
const std::string& TrajectoryReader::engine() const { return file_->engine; }
const std::string& TrajectoryReader::version() const { return file_->writer_version; }
double TrajectoryReader::time_step() const { return file_->time_step; }
const Scene& TrajectoryReader::scene() const { return file_->scene; }
int TrajectoryReader::frames() const { return file_->frames; }

double TrajectoryReader::time(int f) const { return file_->times.at(static_cast<std::size_t>(f)); }

StoredFrame TrajectoryReader::frame(int f) const {
    try {
        return file_->read_frame(f);
    } catch (const std::exception& error) {
        throw RunError(
            fmt::format("{}: frame {}: is damaged: {}; {}", file_->path.string(), f, error.what(), k_remedy));
    }
}

}  // namespace polargrain
