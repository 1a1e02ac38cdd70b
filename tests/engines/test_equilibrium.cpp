#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "src/engines/contact/equilibrium.h"
#include "src/engines/contact/gap_motion.h"

namespace polargrain {
namespace {

constexpr double k_radius = 0.01;  // [m]
constexpr double k_mass = 0.3;     // of a disk [kg/m]
constexpr double k_substep = 1e-4;
constexpr BodyIndex k_floor = -1;
const Vec2 k_kick = k_substep * Vec2(0.0, -9.81);
const double k_weight = k_mass * k_kick.norm();  // in the sub-step [N s/m]

/// Disks and the points at which they touch.
struct Bed {
    std::vector<GapContact> contacts;
    std::vector<double> open;
    std::vector<SolverBody> grains;
    std::vector<double> reach;
    std::vector<Vec2> impulses;

    explicit Bed(std::size_t disks) {
        const double inertia = 0.5 * k_mass * k_radius * k_radius;
        grains.assign(disks, {Vec2::Zero(), 0.0, 1.0 / k_mass, 1.0 / inertia, false});
        reach.assign(disks, k_radius);
    }

    void touch(BodyIndex i, BodyIndex j, const Vec2& normal, double friction = 0.0, double gap = 0.0) {
        GapContact c;
        c.i = i;
        c.j = j;
        c.normal = normal;
        c.friction = friction;
        c.arm_ti = cross(Vec2(-k_radius * normal), c.tangent());
        if (!is_wall(j)) c.arm_tj = cross(Vec2(k_radius * normal), c.tangent());
        contacts.push_back(c);
        open.push_back(gap);
    }

    bool solve() { return find_equilibrium({contacts, open, grains, reach, k_kick, k_substep}, impulses); }
};

Vec2 direction(double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle)};
}

TEST(Equilibrium, OfAColumnPutsOnEveryDiskTheWeightAboveIt) {
    constexpr int disks = 30;
    Bed bed(disks);
    bed.touch(0, k_floor, Vec2::UnitY());
    for (BodyIndex k = 1; k < disks; ++k) bed.touch(k, k - 1, Vec2::UnitY());
    ASSERT_TRUE(bed.solve());
    for (int k = 0; k < disks; ++k) EXPECT_NEAR(bed.impulses[at(k)].x(), (disks - k) * k_weight, 1e-8 * k_weight);
}

TEST(Equilibrium, OfADiskInAVeeFollowsFromItsAngle) {
    for (const double slope : {20.0, 45.0, 65.0}) {
        Bed bed(1);
        bed.touch(0, k_floor, direction(90.0 - slope));
        bed.touch(0, k_floor, direction(90.0 + slope));
        ASSERT_TRUE(bed.solve()) << slope;
        const double expected = k_weight / (2.0 * std::cos(slope * std::numbers::pi / 180.0));
        EXPECT_NEAR(bed.impulses[0].x(), expected, 1e-8 * k_weight) << slope;
        EXPECT_NEAR(bed.impulses[1].x(), expected, 1e-8 * k_weight) << slope;
    }
}

/// Two walls press on a disk from both sides with any force, as far as its weight goes: a moderate one is found.
TEST(Equilibrium, IsFoundWhereABedHasMoreContactsThanItNeeds) {
    Bed bed(1);
    bed.touch(0, k_floor, Vec2::UnitY());
    bed.touch(0, k_floor, Vec2::UnitX());
    bed.touch(0, k_floor, -Vec2::UnitX());
    bed.touch(0, k_floor, Vec2::UnitY());
    ASSERT_TRUE(bed.solve());
    EXPECT_NEAR(bed.impulses[0].x() + bed.impulses[3].x(), k_weight, 1e-8 * k_weight);
    EXPECT_NEAR(bed.impulses[1].x(), bed.impulses[2].x(), 1e-8 * k_weight);
    for (const Vec2& p : bed.impulses) EXPECT_GE(p.x(), 0.0);
}

TEST(Equilibrium, IsFoundWhereSmoothGrainsMove) {
    Bed bed(2);
    bed.touch(0, k_floor, direction(60.0));                      // slides down
    bed.touch(1, k_floor, Vec2::UnitY(), 0.0, 1e-3 * k_radius);  // falls: the gap is more than it can close
    ASSERT_TRUE(bed.solve());
    EXPECT_NEAR(bed.impulses[0].x(), k_weight * std::sin(std::numbers::pi / 3.0), 1e-8 * k_weight);
    EXPECT_NEAR(bed.impulses[1].x(), 0.0, 1e-8 * k_weight);
}

/// Friction holds a disk between two walls of a vee from turning, but on a slope it rolls.
TEST(Equilibrium, WithFrictionIsFoundOnlyWhereNothingMoves) {
    Bed vee(1);
    vee.touch(0, k_floor, direction(60.0), 0.3);
    vee.touch(0, k_floor, direction(120.0), 0.3);
    ASSERT_TRUE(vee.solve());
    Vec2 sum = Vec2::Zero();
    double torque = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
        const GapContact& c = vee.contacts[k];
        sum += vee.impulses[k].x() * c.normal + vee.impulses[k].y() * c.tangent();
        torque += vee.impulses[k].y() * c.arm_ti;
        EXPECT_LE(std::abs(vee.impulses[k].y()), 0.3 * vee.impulses[k].x() + 1e-9 * k_weight);
    }
    EXPECT_NEAR((sum - Vec2(0.0, k_weight)).norm(), 0.0, 1e-8 * k_weight);
    EXPECT_NEAR(torque, 0.0, 1e-8 * k_weight * k_radius);

    Bed slope(1);
    slope.touch(0, k_floor, direction(60.0), 0.3);
    EXPECT_FALSE(slope.solve());
}

/// A row that is all but flat between two walls: its forces exceed the weight of the bed by far.
TEST(Equilibrium, OfAToggleIsLeftToTheSweeps) {
    for (const double rise : {20.0, 1.0}) {
        Bed bed(3);
        bed.touch(0, k_floor, Vec2::UnitX());
        bed.touch(0, k_floor, Vec2::UnitY());
        bed.touch(1, 0, direction(rise));
        bed.touch(2, 1, direction(-rise));
        bed.touch(2, k_floor, -Vec2::UnitX());
        bed.touch(2, k_floor, Vec2::UnitY());
        EXPECT_EQ(bed.solve(), rise > 10.0) << rise;
        if (rise > 10.0) {
            const double row = k_weight / (2.0 * std::sin(rise * std::numbers::pi / 180.0));
            EXPECT_NEAR(bed.impulses[2].x(), row, 1e-7 * k_weight);
        }
    }
}

}  // namespace
}  // namespace polargrain
