#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "src/engines/contact/contact_engine.h"
#include "src/engines/contact/disk_meeting.h"
#include "src/engines/contact/gap_detection.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

TEST(Meeting, OfDisksThatFlyStraightAtOneAnotherIsAfterTheirGap) {
    const DiskMeeting m = find_meeting({3.0, 0.0}, {-2.0, 0.0}, 1.0, 0.0, 5.0);
    EXPECT_DOUBLE_EQ(m.time, 1.0);
    EXPECT_EQ(m.normal, Vec2(1.0, 0.0));
    EXPECT_DOUBLE_EQ(m.distance, 3.0);
}

TEST(Meeting, ToTheSideHasTheNormalOfTheTriangle) {
    // Offset 0.6 of the touching distance: the centres are 0.8 apart along the flight.
    const DiskMeeting m = find_meeting({4.0, 0.6}, {-1.0, 0.0}, 1.0, 0.0, 9.0);
    EXPECT_NEAR(m.time, 3.2, 1e-15);
    EXPECT_NEAR((m.normal - Vec2(0.8, 0.6)).norm(), 0.0, 1e-15);
    // Along that normal the gap closes at 0.8 and is gone at that time.
    EXPECT_NEAR(m.distance - 1.0, 0.8 * 3.2, 1e-15);
}

TEST(Meeting, OfDisksThatPassIsWhereTheyAreNearest) {
    const DiskMeeting m = find_meeting({4.0, 1.5}, {-1.0, 0.0}, 1.0, 0.0, 9.0);
    EXPECT_DOUBLE_EQ(m.time, 4.0);
    EXPECT_EQ(m.normal, Vec2(0.0, 1.0));
    EXPECT_DOUBLE_EQ(m.distance, 1.5);
}

TEST(Meeting, IsSoughtBetweenTheTimesGiven) {
    EXPECT_DOUBLE_EQ(find_meeting({3.0, 0.0}, {-2.0, 0.0}, 1.0, 0.0, 0.5).time, 0.5);    // they meet later
    EXPECT_DOUBLE_EQ(find_meeting({3.0, 0.0}, {-2.0, 0.0}, 1.0, 0.25, 5.0).time, 1.0);   // after that time
    EXPECT_DOUBLE_EQ(find_meeting({3.0, 0.0}, {-2.0, 0.0}, 1.0, 1.25, 5.0).time, 1.25);  // they overlap by then
    EXPECT_DOUBLE_EQ(find_meeting({3.0, 0.0}, {2.0, 0.0}, 1.0, 0.25, 5.0).time, 0.25);   // they part
    EXPECT_DOUBLE_EQ(find_meeting({3.0, 0.0}, {0.0, 0.0}, 1.0, 0.25, 5.0).time, 0.25);   // nothing moves
}

/// Two disks that meet at an offset, in a step of the critical length, at different times within it.
class TwoDisks : public ::testing::TestWithParam<std::tuple<double, double, double>> {
protected:
    static constexpr double k_radius = 0.01;
    static constexpr double k_speed = 1.5;

    static Scene scene(double offset, double lead, double friction) {
        Scene scene = testing::empty_scene(0.7, friction);
        const ShapeIndex disk = testing::add_disk(scene, k_radius);
        const ShapeIndex small = testing::add_disk(scene, 0.6 * k_radius);
        scene.add(Grain{disk, 0, {0.0, 0.0}, 0.0, {0.3, 0.2}, 4.0});
        scene.add(Grain{small, 0, {0.05 + lead, offset}, 0.0, {0.3 - k_speed, 0.2}, -9.0});
        return scene;
    }
    /// In which the faster one moves by its radius.
    static constexpr double k_dt = 0.6 * k_radius / k_speed;
};

TEST_P(TwoDisks, MeetWhereTheirPathsSay) {
    const auto [share, lead, friction] = GetParam();
    const double touching = 1.6 * k_radius + GapDetection(scene(0.0, 0.0, 0.0)).resting_gap(1, 0);
    const double offset = share * touching;
    Running sim(make_contact, scene(offset, lead * k_radius, friction));
    sim.report.record_impacts = true;
    const double l = testing::angular_momentum(sim.world.grains);
    const Vec2 apart{0.05 + lead * k_radius, offset};
    const double along = std::sqrt(touching * touching - offset * offset);
    const double meet = (apart.x() - along) / k_speed;
    ImpactRecord impact;
    sim.run(0.06, k_dt, [&] {
        for (const ImpactRecord& r : sim.report.impact_records) impact = r;
    });
    ASSERT_EQ(sim.impacts, 1);
    const Vec2 normal = Vec2(along, offset) / touching;  // out of the first into the second
    EXPECT_NEAR((impact.normal - normal).norm(), 0.0, 1e-11);
    EXPECT_NEAR(impact.closing_before, -k_speed * along / touching, 1e-11);
    // Where they are in the end: free flight, impact, free flight, both falling.
    const double end = sim.world.time;
    const double mass = sim.world.grains.mass[1];
    const Vec2 impulse =
        impact.impulse_normal * impact.normal + impact.impulse_tangential * right_normal(impact.normal);
    const Vec2 fall{0.0, -0.5 * 9.81 * end * end};
    const Vec2 there = apart + end * Vec2(0.3 - k_speed, 0.2) + (end - meet) / mass * impulse + fall;
    EXPECT_NEAR((sim.world.grains.position(1) - there).norm(), 0.0, 1e-12);
    // About the origin gravity turns what falls; both fall alike, about their centre of mass.
    Running weightless(make_contact, [&] {
        Scene s = scene(offset, lead * k_radius, friction);
        s.gravity = Vec2::Zero();
        return s;
    }());
    weightless.run(0.06, k_dt);
    EXPECT_EQ(weightless.impacts, 1);
    EXPECT_NEAR(testing::angular_momentum(weightless.world.grains), l, 1e-12 * mass * k_speed * k_radius);
}

INSTANTIATE_TEST_SUITE_P(OffsetsTimesAndFriction, TwoDisks,
                         ::testing::Combine(::testing::Values(-0.99, -0.6, 0.0, 0.3, 0.8, 0.97),
                                            ::testing::Values(0.0, 0.21, 0.55, 0.93), ::testing::Values(0.0, 0.4)));

TEST(DisksThatPass, ByAThousandthOfTheirDistanceAreNotStruck) {
    Scene scene = testing::empty_scene(0.7, 0.4);
    const ShapeIndex disk = testing::add_disk(scene, 0.01);
    const double touching = 0.02 + GapDetection([&] {
                                       Scene two = scene;
                                       for (int k = 0; k < 2; ++k) two.add(Grain{disk, 0, {0.05 * k, 0.0}});
                                       return two;
                                   }())
                                       .resting_gap(1, 0);
    scene.gravity = Vec2::Zero();
    scene.add(Grain{disk, 0, {0.0, 0.0}});
    scene.add(Grain{disk, 0, {0.05, 1.001 * touching}, 0.0, {-1.0, 0.0}});
    Running sim(make_contact, scene);
    sim.run(0.1, 0.01);
    EXPECT_EQ(sim.impacts, 0);
    EXPECT_EQ(sim.world.grains.velocity(0), Vec2::Zero());
    EXPECT_EQ(sim.world.grains.velocity(1), Vec2(-1.0, 0.0));
}

}  // namespace
}  // namespace polargrain
