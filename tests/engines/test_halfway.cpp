#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/engines/contact/halfway.h"
#include "tests/support/trial_moves.h"

namespace polargrain {
namespace {

using testing::TrialMoves;

constexpr double k_radius = 0.01;

/// Grains on the move, and the contacts that are found where they start.
struct Moving {
    TrialMoves at;
    Halfway halfway;
    std::vector<PairContacts> pairs;
    std::vector<GapContact> contacts;

    explicit Moving(const Scene& scene) : at(scene), halfway(at.scene) {
        at.detect();
        at.detection.hand_over(pairs, contacts);
    }

    void find(double dt) { halfway.find(at.before, at.bodies, dt); }

    /// Where a grain is after half a step.
    Pose middle(GrainIndex grain, double dt) const {
        const std::size_t k = Grains::at(grain);
        return Pose::at(at.before.centre[k] + 0.5 * dt * at.bodies[k].velocity,
                        at.before.angle[k] + 0.5 * dt * at.bodies[k].spin);
    }
};

Scene two_disks(double gap, double other_radius = k_radius) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    const Vec2 along(0.6, 0.8);
    scene.add(Grain{testing::add_disk(scene, k_radius), 0, {0.1, 0.2}});
    scene.add(
        Grain{testing::add_disk(scene, other_radius), 0, Vec2(0.1, 0.2) + (k_radius + other_radius + gap) * along});
    return scene;
}

/// A small box that stands with one foot on a large one, both turned.
Scene two_boxes(const Vec2& velocity, double spin, const Vec2& velocity_below, double spin_below) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    const double angle = 0.2;
    const Pose below = Pose::at({0.3, 0.1}, angle);
    const double lean = 0.4;
    const Vec2 foot_to_centre(0.005 * std::cos(lean) - 0.01 * std::sin(lean),
                              0.005 * std::sin(lean) + 0.01 * std::cos(lean));
    const ShapeIndex large = testing::add_rectangle(scene, 0.06, 0.02);
    const ShapeIndex small = testing::add_rectangle(scene, 0.01, 0.02);
    scene.add(Grain{large, 0, below.centre, angle, velocity_below, spin_below});
    scene.add(Grain{small, 0, below.to_world(Vec2(0.01, 0.01 + 1e-5) + foot_to_centre), angle + lean, velocity, spin});
    return scene;
}

TEST(Halfway, FindsCentresAfterHalfAStep) {
    Moving moving(two_boxes({1.0, -2.0}, 3.0, {0.5, 0.25}, -1.0));
    moving.find(4e-3);
    EXPECT_NEAR((moving.halfway.centre(0) - moving.at.before.centre[0] - 2e-3 * Vec2(0.5, 0.25)).norm(), 0.0, 1e-16);
    EXPECT_NEAR((moving.halfway.centre(1) - moving.at.before.centre[1] - 2e-3 * Vec2(1.0, -2.0)).norm(), 0.0, 1e-16);
}

TEST(Halfway, TurnsTrulyAndByAnAngleThatIsOffByATwelfthOfItsCube) {
    for (const double spin : {-300.0, -20.0, 0.0, 1.0, 100.0, 500.0}) {
        Moving moving(two_boxes(Vec2::Zero(), spin, Vec2::Zero(), 0.0));
        const double dt = 2e-3;
        moving.find(dt);
        const Vec2 v(3.0, -4.0);
        const Vec2 turned = moving.halfway.turned(1, v);
        EXPECT_NEAR(turned.norm(), 5.0, 1e-14) << "spin " << spin;
        const double angle = std::atan2(cross(v, turned), v.dot(turned));
        const double wanted = 0.5 * dt * spin;
        EXPECT_NEAR(angle, wanted - wanted * wanted * wanted / 12.0, 0.02 * std::abs(std::pow(wanted, 5)) + 1e-15);
    }
}

TEST(Halfway, OfNoTimeLeavesContactsOfPolygonsWhereTheyAre) {
    Moving moving(two_boxes({1.0, -2.0}, 30.0, {0.5, 0.25}, -10.0));
    ASSERT_EQ(moving.contacts.size(), 1U);
    GapContact carried = moving.contacts[0];
    moving.find(0.0);
    moving.halfway.carry(carried);
    EXPECT_NEAR((carried.point - moving.contacts[0].point).norm(), 0.0, 1e-16);
    EXPECT_EQ(carried.normal, moving.contacts[0].normal);
    EXPECT_EQ(moving.halfway.centre(1), moving.at.before.centre[1]);
}

TEST(Halfway, CarriesAVertexWithItsGrainAndTheNormalWithTheEdgeThatItFaces) {
    // Against where the rigid bodies really are by then, to the third order in what they have turned.
    const double dt = 1e-3;
    for (const double spin : {-40.0, 0.0, 40.0}) {
        for (const double spin_below : {-30.0, 0.0, 30.0}) {
            Moving moving(two_boxes({1.0, -2.0}, spin, {0.5, 0.25}, spin_below));
            ASSERT_EQ(moving.contacts.size(), 1U);
            const GapContact& found = moving.contacts[0];
            ASSERT_TRUE(found.i == 1 && found.on_i && found.vertex >= 0);
            GapContact carried = found;
            moving.find(dt);
            moving.halfway.carry(carried);
            const Vec2 on_grain = moving.at.before.pose[1].to_local(found.point);
            const Vec2 to_edge = moving.at.before.pose[0].turned_back(found.normal);
            const double third_order = std::pow(0.5 * dt * 40.0, 3) / 12.0 + 1e-14;
            EXPECT_NEAR((carried.point - moving.middle(1, dt).to_world(on_grain)).norm(), 0.0, 0.02 * third_order);
            EXPECT_NEAR((carried.normal - moving.middle(0, dt).turned(to_edge)).norm(), 0.0, third_order);
            for (const GrainIndex k : {0, 1}) {
                EXPECT_EQ(moving.halfway.arm(carried, k), Vec2(carried.point - moving.halfway.centre(k)));
            }
        }
    }
}

TEST(Halfway, CarriesAVertexOverAWallThatKeepsItsNormal) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    testing::add_wall(scene, "slope", {{-0.2, 0.0}, {0.2, 0.1}});
    const Vec2 up = left_normal(unit(Vec2(0.4, 0.1)));
    const ShapeIndex box = testing::add_rectangle(scene, 0.02, 0.02);
    const Vec2 corner = std::sqrt(2.0) * 0.01 * up;
    scene.add(Grain{
        box, 0, Vec2(0.0, 0.05) + corner + 1e-5 * up, std::atan2(0.1, 0.4) + 0.25 * std::acos(-1.0), {0.3, 0.4}, 20.0});
    Moving moving(scene);
    ASSERT_EQ(moving.contacts.size(), 1U);
    GapContact carried = moving.contacts[0];
    moving.find(1e-3);
    moving.halfway.carry(carried);
    EXPECT_NEAR((carried.normal - up).norm(), 0.0, 1e-15);
    const Vec2 on_grain = moving.at.before.pose[0].to_local(moving.contacts[0].point);
    const double turned = 0.5e-3 * 20.0;
    EXPECT_NEAR((carried.point - moving.middle(0, 1e-3).to_world(on_grain)).norm(), 0.0,
                1.01 * corner.norm() * std::pow(turned, 3) / 12.0);
}

TEST(Halfway, LeavesTheEndOfAWallWhereItIsAndTurnsTheNormalWithTheGrain) {
    // A box on the free end of a wall that stands upright.
    Scene scene = testing::empty_scene(0.3, 0.2);
    testing::add_wall(scene, "post", {{0.0, -0.5}, {0.0, 0.0}});
    const ShapeIndex box = testing::add_rectangle(scene, 0.04, 0.02);
    scene.add(Grain{box, 0, {0.005, 0.01 + 1e-5}, 0.0, {0.1, 0.0}, 40.0});
    Moving moving(scene);
    ASSERT_EQ(moving.contacts.size(), 1U);
    ASSERT_FALSE(moving.contacts[0].on_i);
    GapContact carried = moving.contacts[0];
    moving.find(1e-3);
    moving.halfway.carry(carried);
    EXPECT_EQ(carried.point, moving.contacts[0].point);
    EXPECT_NEAR((carried.normal - Vec2(-std::sin(0.02), std::cos(0.02))).norm(), 0.0, 1e-6);
    EXPECT_EQ(moving.halfway.arm(carried, 0), Vec2(carried.point - moving.halfway.centre(0)));
}

TEST(Halfway, GivesADiskOnAWallTheArmOfItsRadiusWhateverItsGap) {
    for (const double gap : {0.0, 1e-5, 3e-5}) {
        Scene scene = testing::empty_scene(0.3, 0.2);
        testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
        scene.add(Grain{testing::add_disk(scene, k_radius), 0, {0.1, k_radius + gap}, 0.0, {2.0, 0.0}, 50.0});
        Moving moving(scene);
        ASSERT_EQ(moving.contacts.size(), 1U);
        GapContact carried = moving.contacts[0];
        moving.find(1e-3);
        moving.halfway.carry(carried);
        EXPECT_NEAR((moving.halfway.arm(carried, 0) - Vec2(0.0, -k_radius)).norm(), 0.0, 1e-17) << "gap " << gap;
        EXPECT_NEAR((carried.point - Vec2(0.101, gap)).norm(), 0.0, 1e-16) << "below its centre after half a step";
    }
}

TEST(Halfway, TurnsTheNormalOfTwoDisksWithTheLineOfTheirCentres) {
    Moving moving(two_disks(1e-5));
    moving.at.bodies[1].velocity = {2.0, -1.5};
    moving.at.bodies[1].spin = 100.0;
    ASSERT_EQ(moving.contacts.size(), 1U);
    GapContact carried = moving.contacts[0];
    moving.find(1e-3);
    moving.halfway.carry(carried);
    const Vec2 apart = moving.middle(1, 1e-3).centre - moving.middle(0, 1e-3).centre;
    EXPECT_NEAR((carried.normal - unit(apart)).norm(), 0.0, 1e-15);
    EXPECT_NEAR(cross(moving.halfway.arm(carried, 0), carried.normal), 0.0, 1e-17) << "a push does not turn a disk";
    EXPECT_NEAR(cross(moving.halfway.arm(carried, 1), carried.normal), 0.0, 1e-17);
}

TEST(Halfway, LetsTheArmsOfTwoDisksMeetWhereTheyRest) {
    for (const double part : {0.0, 0.3, 1.0}) {
        const double other = 0.5 * k_radius;
        const double resting = 2.0 * other * GapDetection::k_resting;
        Moving moving(two_disks(part * resting, other));
        ASSERT_EQ(moving.contacts.size(), 1U);
        GapContact carried = moving.contacts[0];
        moving.find(1e-3);
        moving.halfway.carry(carried);
        const Vec2 arm_0 = moving.halfway.arm(carried, 0);
        const Vec2 arm_1 = moving.halfway.arm(carried, 1);
        EXPECT_NEAR((moving.halfway.centre(0) + arm_0 - moving.halfway.centre(1) - arm_1).norm(), 0.0, 1e-16);
        EXPECT_NEAR((carried.point - moving.halfway.centre(0) - arm_0).norm(), 0.0, 1e-16);
        EXPECT_NEAR(arm_0.norm() - k_radius, arm_1.norm() - other, 1e-17) << "each takes half of the gap";
    }
}

TEST(Halfway, GivesDisksThatAreFarApartOrOverlapTheArmsOfAClosedGap) {
    for (const double gap : {-1e-4, 2.2e-5, 3.5e-5}) {
        Moving moving(two_disks(gap));
        ASSERT_EQ(moving.contacts.size(), 1U);
        GapContact carried = moving.contacts[0];
        const double resting = carried.resting;
        moving.find(1e-3);
        moving.halfway.carry(carried);
        for (const GrainIndex k : {0, 1}) {
            EXPECT_NEAR(moving.halfway.arm(carried, k).norm(), k_radius + (gap > 0.0 ? 0.5 * resting : 0.0), 1e-16);
        }
    }
}

TEST(Halfway, LaysTheContactOfADiskOnABoxBelowTheDiskAlongTheBoxsNormal) {
    // Whichever of the two is the first: the contact's i is the later grain.
    for (const bool disk_first : {true, false}) {
        Scene scene = testing::empty_scene(0.3, 0.2);
        const ShapeIndex disk = testing::add_disk(scene, k_radius);
        const ShapeIndex box = testing::add_rectangle(scene, 0.06, 0.02);
        const Grain on_top{disk, 0, {0.01, 0.01 + k_radius + 1e-5}, 0.0, {1.0, 0.0}, -100.0};
        const Grain below{box, 0, {0.0, 0.0}, 0.0, {0.0, 0.5}, 20.0};
        scene.add(disk_first ? on_top : below);
        scene.add(disk_first ? below : on_top);
        const GrainIndex d = disk_first ? 0 : 1;
        Moving moving(scene);
        ASSERT_EQ(moving.contacts.size(), 1U);
        ASSERT_EQ(moving.contacts[0].on_i, !disk_first);
        GapContact carried = moving.contacts[0];
        moving.find(1e-3);
        moving.halfway.carry(carried);
        const Vec2 up = Vec2(-std::sin(0.01), std::cos(0.01));
        EXPECT_NEAR((carried.normal - (disk_first ? -up : up).eval()).norm(), 0.0, 1e-6);
        EXPECT_NEAR((moving.halfway.arm(carried, d) + k_radius * up).norm(), 0.0, 1e-8);
        EXPECT_NEAR((carried.point - moving.halfway.centre(d) - moving.halfway.arm(carried, d)).norm(), 0.0, 1e-16);
        EXPECT_EQ(moving.halfway.arm(carried, 1 - d), Vec2(carried.point - moving.halfway.centre(1 - d)));
    }
}

}  // namespace
}  // namespace polargrain
