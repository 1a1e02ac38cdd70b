#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <csignal>

#include "src/core/error.h"
#include "src/record/trajectory_h5.h"
#include "src/record/trajectory_reader.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::content;
using testing::report_at;
using testing::small_scene;
using testing::TemporaryFolder;
using testing::world_at;

constexpr double k_dt = 0.001;
constexpr int k_frames = 5;

void write_frames(TrajectoryH5& trajectory, const Scene& scene, int frames) {
    for (int f = 0; f < frames; ++f) {
        const StepReport report = report_at(scene, 4 * f);
        trajectory.sample({scene, world_at(scene, 4 * f, k_dt), report, Totals{}});
    }
}

void write_trajectory(const Scene& scene, const std::filesystem::path& path) {
    TrajectoryH5 trajectory(path, 0.004, {"1.2.3", "g++", "A. Tester"});
    trajectory.begin(scene, testing::run_info());
    write_frames(trajectory, scene, k_frames);
    trajectory.end();
}

/// Reads by the plain C interface, so that the writer's own wrapper is not its witness.
class PlainFile {
public:
    explicit PlainFile(const std::filesystem::path& path) : id_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
    ~PlainFile() { H5Fclose(id_); }
    PlainFile(const PlainFile&) = delete;
    PlainFile& operator=(const PlainFile&) = delete;

    bool valid() const { return id_ >= 0; }

    std::vector<hsize_t> extent(const std::string& name) const {
        const hid_t dataset = H5Dopen2(id_, name.c_str(), H5P_DEFAULT);
        if (dataset < 0) return {};
        const hid_t space = H5Dget_space(dataset);
        std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
        H5Sget_simple_extent_dims(space, size.data(), nullptr);
        H5Sclose(space);
        H5Dclose(dataset);
        return size;
    }

    std::vector<double> doubles(const std::string& name) const {
        std::size_t count = 1;
        for (const hsize_t n : extent(name)) count *= static_cast<std::size_t>(n);
        std::vector<double> values(count);
        const hid_t dataset = H5Dopen2(id_, name.c_str(), H5P_DEFAULT);
        H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Dclose(dataset);
        return values;
    }

    std::string text(const std::string& object, const std::string& attribute) const {
        const hid_t id = H5Aopen_by_name(id_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        if (id < 0) return "absent";
        const hid_t type = H5Aget_type(id);
        char* value = nullptr;
        H5Aread(id, type, static_cast<void*>(&value));
        std::string copy = value;
        H5free_memory(value);
        H5Tclose(type);
        H5Aclose(id);
        return copy;
    }

    double number(const std::string& object, const std::string& attribute) const {
        const hid_t id = H5Aopen_by_name(id_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        double value = -1e300;
        H5Aread(id, H5T_NATIVE_DOUBLE, &value);
        H5Aclose(id);
        return value;
    }

private:
    hid_t id_;
};

using Extent = std::vector<hsize_t>;

TEST(TrajectoryH5, LaysOutWhatH5mdAsksFor) {
    const TemporaryFolder folder("h5-layout");
    const Scene scene = small_scene();
    write_trajectory(scene, folder / "trajectory.h5");
    const PlainFile file(folder / "trajectory.h5");
    ASSERT_TRUE(file.valid());
    EXPECT_EQ(file.text("/h5md/author", "name"), "A. Tester");
    EXPECT_EQ(file.text("/h5md/creator", "name"), "polargrain");
    EXPECT_EQ(file.text("/h5md/creator", "version"), "1.2.3");
    EXPECT_EQ(file.number("/particles/grains/box", "dimension"), 2.0);
    for (const char* pairs : {"position", "velocity"}) {
        EXPECT_EQ(file.extent(std::string("/particles/grains/") + pairs + "/value"), (Extent{k_frames, 4, 2})) << pairs;
    }
    for (const char* single : {"angle", "spin"}) {
        EXPECT_EQ(file.extent(std::string("/particles/grains/") + single + "/value"), (Extent{k_frames, 4})) << single;
    }
    for (const char* element : {"position", "angle", "velocity", "spin"}) {
        const std::string group = std::string("/particles/grains/") + element;
        EXPECT_EQ(file.doubles(group + "/step"), (std::vector<double>{0, 4, 8, 12, 16})) << element;
        EXPECT_EQ(file.doubles(group + "/time")[3], 12 * k_dt) << element;
    }
    EXPECT_EQ(file.text("/particles/grains/velocity/value", "unit"), "m s-1");
    EXPECT_EQ(file.doubles("/particles/grains/mass"), scene.grains.mass);
    EXPECT_EQ(file.doubles("/particles/grains/shape"), (std::vector<double>{0, 0, 1, 2}));
    EXPECT_EQ(file.doubles("/particles/grains/material"), (std::vector<double>{0, 1, 0, 1}));
}

TEST(TrajectoryH5, PositionsKeepAllTheirBits) {
    const TemporaryFolder folder("h5-bits");
    const Scene scene = small_scene();
    write_trajectory(scene, folder / "trajectory.h5");
    const std::vector<double> positions =
        PlainFile(folder / "trajectory.h5").doubles("/particles/grains/position/value");
    for (int f = 0; f < k_frames; ++f) {
        const World world = world_at(scene, 4 * f, k_dt);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(positions[(static_cast<std::size_t>(f) * 4 + k) * 2], world.grains.x[k]);
            EXPECT_EQ(positions[(static_cast<std::size_t>(f) * 4 + k) * 2 + 1], world.grains.y[k]);
        }
    }
}

TEST(TrajectoryH5, ShapesStandUnderTheirNamesWithTheIndexThatGrainsPointTo) {
    const TemporaryFolder folder("h5-shapes");
    write_trajectory(small_scene(), folder / "trajectory.h5");
    const PlainFile file(folder / "trajectory.h5");
    EXPECT_EQ(file.number("/polargrain/shapes/ball", "radius"), 0.01);
    EXPECT_EQ(file.number("/polargrain/shapes/ball", "index"), 0.0);
    EXPECT_EQ(file.extent("/polargrain/shapes/bracket/vertices"), (Extent{6, 2}));
    EXPECT_EQ(file.number("/polargrain/shapes/bracket", "index"), 1.0);
    EXPECT_EQ(file.number("/polargrain/shapes/bracket#2", "index"), 2.0);
}

TEST(TrajectoryH5, WallsMoveInTheFileAsTheyDoInTheScene) {
    const TemporaryFolder folder("h5-walls");
    const Scene scene = small_scene();
    write_trajectory(scene, folder / "trajectory.h5");
    const PlainFile file(folder / "trajectory.h5");
    EXPECT_EQ(file.number("/polargrain/walls/gate", "remove_at"), 0.01);
    EXPECT_TRUE(file.extent("/polargrain/walls/floor/pose/value").empty()) << "the floor stands still";
    const std::vector<double> poses = file.doubles("/polargrain/walls/shaker/pose/value");
    ASSERT_EQ(poses.size(), 4u * k_frames);
    for (std::size_t f = 0; f < k_frames; ++f) {
        const double time = static_cast<double>(4 * f) * k_dt;
        EXPECT_NEAR(poses[4 * f], 0.002 * std::sin(2.0 * k_pi * 20.0 * time), 1e-15) << "frame " << f;
    }
}

TEST(TrajectoryH5, WhatIsWrittenIsReadBack) {
    const TemporaryFolder folder("h5-round-trip");
    const Scene scene = small_scene();
    write_trajectory(scene, folder / "trajectory.h5");
    const TrajectoryReader reader(folder / "trajectory.h5");
    EXPECT_EQ(reader.title(), "Small scene");
    EXPECT_EQ(reader.version(), "1.2.3");
    ASSERT_EQ(reader.frames(), k_frames);
    ASSERT_EQ(reader.scene().shapes.size(), 3u);
    EXPECT_EQ(name(reader.scene().shape(2)), "bracket");
    EXPECT_EQ(std::get<PolarPolygon>(reader.scene().shape(1)).vertices(),
              std::get<PolarPolygon>(scene.shape(1)).vertices());
    EXPECT_EQ(polar_moment(reader.scene().shape(1)), polar_moment(scene.shape(1)));
    EXPECT_EQ(reader.scene().materials[1].name, "steel");
    EXPECT_EQ(reader.scene().walls[3].remove_at, 0.01);
    EXPECT_EQ(reader.scene().gravity, scene.gravity);
    for (int f = 0; f < k_frames; ++f) {
        const StoredFrame frame = reader.frame(f);
        const World world = world_at(scene, 4 * f, k_dt);
        EXPECT_EQ(state_hash(frame.world), state_hash(world)) << "frame " << f;
        EXPECT_EQ(frame.world.time, world.time);
        EXPECT_EQ(frame.world.grains.mass, world.grains.mass);
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            const Pose expected = wall_state(scene.walls[w], world.time).pose;
            EXPECT_EQ(frame.wall_poses[w].centre, expected.centre);
            EXPECT_EQ(frame.wall_poses[w].sine, expected.sine);
        }
    }
}

TEST(TrajectoryH5, ContactsOfEachFrameComeBackAsTheyWere) {
    const TemporaryFolder folder("h5-contacts");
    const Scene scene = small_scene();
    write_trajectory(scene, folder / "trajectory.h5");
    const TrajectoryReader reader(folder / "trajectory.h5");
    std::size_t all = 0;
    for (int f = 0; f < k_frames; ++f) {
        const std::vector<Contact> expected = report_at(scene, 4 * f).contacts;
        const std::vector<Contact> found = reader.frame(f).contacts;
        ASSERT_EQ(found.size(), expected.size()) << "frame " << f;
        for (std::size_t c = 0; c < expected.size(); ++c) {
            EXPECT_EQ(found[c].a, expected[c].a);
            EXPECT_EQ(found[c].b, expected[c].b);
            EXPECT_EQ(found[c].point, expected[c].point);
            EXPECT_EQ(found[c].normal, expected[c].normal);
            EXPECT_EQ(found[c].gap, expected[c].gap);
            EXPECT_EQ(found[c].impulse, expected[c].impulse);
        }
        all += expected.size();
    }
    EXPECT_GT(all, 3u);
}

TEST(TrajectoryH5, EqualRunsWriteEqualBytes) {
    const TemporaryFolder folder("h5-bytes");
    write_trajectory(small_scene(), folder / "a.h5");
    write_trajectory(small_scene(), folder / "b.h5");
    EXPECT_EQ(content(folder / "a.h5"), content(folder / "b.h5"));
}

TEST(TrajectoryH5, AKilledProgramLeavesAllFramesButTheLastStepReadable) {
    const TemporaryFolder folder("h5-kill");
    const Scene scene = small_scene();
    TrajectoryH5 trajectory(folder / "running.h5", 0.004, {});
    trajectory.begin(scene, testing::run_info());
    write_frames(trajectory, scene, 3);
    std::filesystem::copy_file(folder / "running.h5", folder / "found.h5");  // as a kill at this instant leaves it
    const TrajectoryReader reader(folder / "found.h5");
    ASSERT_EQ(reader.frames(), 3);
    EXPECT_EQ(state_hash(reader.frame(2).world), state_hash(world_at(scene, 8, k_dt)));
    trajectory.end();
}

TEST(TrajectoryH5, ASceneWithoutGrainsOrWallsIsAFileToo) {
    const TemporaryFolder folder("h5-empty");
    Scene scene;
    {
        TrajectoryH5 trajectory(folder / "empty.h5", 0.004, {});
        trajectory.begin(scene, testing::run_info());
        const StepReport nothing;
        trajectory.sample({scene, initial_world(scene), nothing, Totals{}});
        trajectory.end();
    }
    const TrajectoryReader reader(folder / "empty.h5");
    EXPECT_EQ(reader.frames(), 1);
    EXPECT_TRUE(reader.frame(0).world.grains.empty());
}

TEST(TrajectoryH5, FolderThatIsNotThereIsNamed) {
    TrajectoryH5 trajectory("/nowhere/at/all/trajectory.h5", 0.1, {});
    try {
        trajectory.begin(small_scene(), testing::run_info());
        FAIL() << "wrote into a folder that does not exist";
    } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("/nowhere/at/all/trajectory.h5"), std::string::npos) << error.what();
    }
}

/// Files of this program may not grow beyond the limit while this lives: what a full disk looks like to a writer.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : previous_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &previous_);
        const rlimit limit{bytes, previous_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &previous_);
        std::signal(SIGXFSZ, previous_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    rlimit previous_{};
    void (*previous_handler_)(int);
};

TEST(TrajectoryH5, FullDiskEndsTheRunByName) {
    const TemporaryFolder folder("h5-full");
    const Scene scene = small_scene();
    const FileSizeLimit limit(100'000);
    std::string message;
    try {
        TrajectoryH5 trajectory(folder / "trajectory.h5", 0.004, {});
        trajectory.begin(scene, testing::run_info());
        write_frames(trajectory, scene, 2000);
    } catch (const RunError& error) {
        message = error.what();
    }
    EXPECT_NE(message.find("trajectory.h5"), std::string::npos) << message;
}

TEST(TrajectoryReader, SaysWhatIsWrongWithAFileThatIsNotOurs) {
    const TemporaryFolder folder("h5-foreign");
    EXPECT_THROW(TrajectoryReader(folder / "absent.h5"), InputError);
    std::ofstream(folder / "text.h5") << "not an HDF5 file";
    EXPECT_THROW(TrajectoryReader(folder / "text.h5"), InputError);
    H5Fclose(H5Fcreate((folder / "foreign.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    EXPECT_THROW(TrajectoryReader(folder / "foreign.h5"), InputError);
}

TEST(TrajectoryReader, AFrameThatIsNotThereIsARunError) {
    const TemporaryFolder folder("h5-range");
    write_trajectory(small_scene(), folder / "trajectory.h5");
    const TrajectoryReader reader(folder / "trajectory.h5");
    EXPECT_THROW(reader.frame(k_frames), RunError);
}

}  // namespace
}  // namespace polargrain
