#include <gtest/gtest.h>

#include "src/record/trajectory_h5.h"
#include "src/record/trajectory_reader.h"
#include "tests/record/recorded_writes.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::recorded_writes;

constexpr double k_dt = 0.001;

/// The small scene, and a row of more disks: how many decides in which frames the file grows.
Scene scene_with(int more_disks) {
    Scene scene = testing::small_scene();
    for (int k = 0; k < more_disks; ++k) scene.add(Grain{0, 0, {1.0 + 0.02 * k, 0.5}, 0.1 * k, {0.1, 0.2}, 0.3});
    return scene;
}

struct Recorded {
    std::string begun;                     // the file before its first frame
    std::vector<testing::Write> writes;    // all that came afterwards
    std::vector<std::size_t> frame_after;  // how many of them each frame took, with all frames before it
};

Recorded record(const Scene& scene, const std::filesystem::path& path, int frames) {
    Recorded recorded;
    TrajectoryH5 trajectory(path, k_dt, {"1.2.3", "g++", "A. Tester"});
    trajectory.begin(scene, testing::run_info());
    recorded.begun = testing::content(path);
    recorded_writes() = {.wanted = true, .list = {}};
    for (int f = 0; f < frames; ++f) {
        const StepReport report = testing::report_at(scene, f);
        trajectory.sample({scene, testing::world_at(scene, f, k_dt), report, Totals{}});
        recorded.frame_after.push_back(recorded_writes().list.size());
    }
    recorded_writes().wanted = false;
    recorded.writes = recorded_writes().list;
    trajectory.end();
    return recorded;
}

void expect_frame(const StoredFrame& frame, const Scene& scene, int f) {
    const World right = testing::world_at(scene, f, k_dt);
    EXPECT_EQ(frame.world.time, right.time);
    EXPECT_EQ(frame.world.step, right.step);
    EXPECT_EQ(frame.world.grains.x, right.grains.x);
    EXPECT_EQ(frame.world.grains.y, right.grains.y);
    EXPECT_EQ(frame.world.grains.vx, right.grains.vx);
    EXPECT_EQ(frame.world.grains.vy, right.grains.vy);
    EXPECT_EQ(frame.world.grains.angle, right.grains.angle);
    EXPECT_EQ(frame.world.grains.spin, right.grains.spin);
    const std::vector<Contact> contacts = testing::report_at(scene, f).contacts;
    ASSERT_EQ(frame.contacts.size(), contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) EXPECT_EQ(frame.contacts[c].impulse, contacts[c].impulse);
}

class KilledTrajectory : public ::testing::TestWithParam<int> {};

TEST_P(KilledTrajectory, HasAllItsWholeFramesAfterEveryWrite) {
    constexpr int frames = 6;
    const testing::TemporaryFolder folder("killed");
    const Scene scene = scene_with(GetParam());
    const Recorded recorded = record(scene, folder / "whole.h5", frames);
    ASSERT_GT(recorded.writes.size(), 10U * frames);
    std::string file = recorded.begun;
    for (std::size_t n = 0; n <= recorded.writes.size(); ++n) {
        if (n > 0) recorded.writes[n - 1].put_into(file);
        SCOPED_TRACE(::testing::Message() << "killed after write " << n);
        std::ofstream(folder / "killed.h5", std::ios::binary) << file;
        const auto whole = std::ranges::count_if(recorded.frame_after, [n](std::size_t needed) { return needed <= n; });
        const TrajectoryReader reader(folder / "killed.h5");
        ASSERT_GE(reader.frames(), whole);
        ASSERT_LE(reader.frames(), whole + 1) << "the next may be whole before the system hears the last of it";
        for (int f = 0; f < reader.frames(); ++f) expect_frame(reader.frame(f), scene, f);
    }
}

// With so few, no dataset needs a second chunk; with more, some do in each frame, or in every other one.
INSTANTIATE_TEST_SUITE_P(OfGrains, KilledTrajectory, ::testing::Values(0, 250, 600),
                         [](const auto& with) { return std::to_string(with.param + 4); });

}  // namespace
}  // namespace polargrain
