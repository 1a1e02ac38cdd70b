#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "src/engines/contact/active_pushes.h"
#include "src/engines/contact/equilibrium.h"
#include "src/engines/contact/gap_motion.h"
#include "src/engines/contact/interior_point.h"

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
    std::vector<Vec2> free_velocity;  // what gravity's kick makes of the disks' own
    std::vector<double> free_spin;
    std::vector<Vec2> impulses;

    explicit Bed(std::size_t disks) {
        const double inertia = 0.5 * k_mass * k_radius * k_radius;
        grains.assign(disks, {Vec2::Zero(), 0.0, 1.0 / k_mass, 1.0 / inertia, false});
        reach.assign(disks, k_radius);
        free_velocity.assign(disks, k_kick);
        free_spin.assign(disks, 0.0);
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

    SlowBed slow() const { return {contacts, open, grains, reach, free_velocity, free_spin, k_kick, k_substep}; }

    bool solve() {
        const auto found = find_equilibrium(slow());
        if (found) impulses = *found;
        return found.has_value();
    }
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
TEST(Equilibrium, OfAToggleFollowsFromItsRise) {
    for (const double rise : {20.0, 1.0, 0.05}) {
        Bed bed(3);
        bed.touch(0, k_floor, Vec2::UnitX());
        bed.touch(0, k_floor, Vec2::UnitY());
        bed.touch(1, 0, direction(rise));
        bed.touch(2, 1, direction(-rise));
        bed.touch(2, k_floor, -Vec2::UnitX());
        bed.touch(2, k_floor, Vec2::UnitY());
        ASSERT_TRUE(bed.solve()) << rise;
        const double row = k_weight / (2.0 * std::sin(rise * std::numbers::pi / 180.0));
        EXPECT_NEAR(bed.impulses[2].x(), row, 1e-6 * row) << rise;
    }
}

/// A disk that moves towards the floor and one that leaves it.
TEST(Equilibrium, BeginsWithTheSpeedsThatTheGrainsHave) {
    Bed bed(2);
    bed.touch(0, k_floor, Vec2::UnitY());
    bed.touch(1, k_floor, Vec2::UnitY());
    bed.free_velocity[0] = 3.0 * k_kick;
    bed.free_velocity[1] = -0.5 * k_kick;
    ASSERT_TRUE(bed.solve());
    EXPECT_NEAR(bed.impulses[0].x(), 3.0 * k_weight, 1e-8 * k_weight);
    EXPECT_NEAR(bed.impulses[1].x(), 0.0, 1e-8 * k_weight);
}

/// A pyramid of disks on a floor, pushed by some of its contacts alone in the guess.
struct Pyramid : Bed {
    static constexpr int k_rows = 6;

    Pyramid() : Bed(k_rows * (k_rows + 1) / 2) {
        for (int row = 0; row < k_rows; ++row) {
            for (int k = 0; k < k_rows - row; ++k) {
                if (row == 0) touch(disk(row, k), k_floor, Vec2::UnitY());
                if (row == 0 && k > 0) touch(disk(row, k), disk(row, k - 1), Vec2::UnitX());
                if (row > 0) touch(disk(row, k), disk(row - 1, k), direction(60.0));
                if (row > 0) touch(disk(row, k), disk(row - 1, k + 1), direction(120.0));
            }
        }
        touch(disk(0, 0), k_floor, Vec2::UnitX());
        touch(disk(0, k_rows - 1), k_floor, -Vec2::UnitX());
    }

    static BodyIndex disk(int row, int k) { return static_cast<BodyIndex>(row * k_rows - row * (row - 1) / 2 + k); }
};

TEST(Equilibrium, OfTheGuessedPushesIsThatOfTheInteriorPoint) {
    Pyramid bed;
    PushSystem from_nothing(bed.slow());
    const auto interior = solve_interior(from_nothing);
    ASSERT_TRUE(interior);
    // The pair of the row that has hardly pushed, and one that has pushed too little.
    const std::vector<Vec2> found = from_nothing.contact_impulses(interior->impulses);
    for (std::size_t k = 0; k < found.size(); ++k) bed.contacts[k].normal_impulse = found[k].x();
    bed.contacts[5].normal_impulse *= 0.5;
    PushSystem guessed(bed.slow());
    const auto active = solve_active(guessed);
    ASSERT_TRUE(active);
    double weight = 0.0;
    const std::vector<Vec2> again = guessed.contact_impulses(active->impulses);
    for (std::size_t k = 0; k < again.size(); ++k) {
        EXPECT_GE(again[k].x(), 0.0) << k;
        if (bed.contacts[k].normal == Vec2::UnitY()) weight += again[k].x();
    }
    EXPECT_NEAR(weight, static_cast<double>(bed.grains.size()) * k_weight, 1e-7 * k_weight);
    for (std::size_t row = 0; row < interior->speeds.size(); ++row) {
        EXPECT_NEAR(active->speeds[row], interior->speeds[row], 1e-8) << row;
    }
}

/// From no guess the pushes would have to be found one after the other, which is not what it is for; either it finds
/// what holds the bed, or it says that it does not know.
TEST(Equilibrium, OfWrongGuessesIsNeverWrong) {
    for (std::size_t wrong = 0; wrong < 8; ++wrong) {
        Pyramid bed;
        for (std::size_t k = 0; k < bed.contacts.size(); ++k) {
            bed.contacts[k].normal_impulse = k % 8 == wrong ? 0.0 : k_weight;
        }
        PushSystem system(bed.slow());
        const auto active = solve_active(system);
        if (!active) continue;
        PushSystem::Numbers unbalanced;
        system.find_unbalanced(active->speeds, active->impulses, unbalanced);
        for (const double r : unbalanced) EXPECT_NEAR(r, 0.0, 1e-8) << wrong;
        for (std::size_t k = 0; k < system.pushes(); ++k) {
            EXPECT_GE(active->impulses[k], 0.0);
            EXPECT_GE(system.opening(k, active->speeds), system.least(k) - 1e-8);
        }
    }
}

}  // namespace
}  // namespace polargrain
