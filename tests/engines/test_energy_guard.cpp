#include <gtest/gtest.h>

#include <vector>

#include "src/core/random.h"
#include "src/engines/contact/energy_guard.h"

namespace polargrain {
namespace {

/// Grains that fly and spin, every third of which has touched nothing.
std::vector<SolverBody> some_bodies(int n, std::uint64_t seed) {
    RandomStream random(seed, RandomPurpose::test);
    std::vector<SolverBody> bodies;
    for (int k = 0; k < n; ++k) {
        bodies.push_back({{random.normal(), random.normal()},
                          30.0 * random.normal(),
                          random.uniform(0.5, 3.0),
                          random.uniform(1e3, 1e4),
                          k % 3 != 0});
    }
    return bodies;
}

PoseSet somewhere(std::size_t n, std::uint64_t seed) {
    RandomStream random(seed, RandomPurpose::test, 1);
    PoseSet poses;
    poses.resize(n);
    for (Vec2& centre : poses.centre) centre = {random.uniform(), random.uniform()};
    return poses;
}

double kinetic(const std::vector<SolverBody>& bodies, bool touched) {
    double sum = 0.0;
    for (const SolverBody& body : bodies) sum += body.touched == touched ? kinetic_energy(body) : 0.0;
    return sum;
}

bool same_motion(const SolverBody& p, const SolverBody& q) {
    return p.velocity == q.velocity && p.spin == q.spin && p.touched == q.touched;
}

TEST(EnergyGuard, OfAGrainThatFliesAndSpinsAddsBothEnergies) {
    // 3 kg/m at 5 m/s, 0.02 kg m at 10 rad/s
    const SolverBody body{{3.0, -4.0}, 10.0, 1.0 / 3.0, 50.0, false};
    EXPECT_NEAR(kinetic_energy(body), 0.5 * 3.0 * 25.0 + 0.5 * 0.02 * 100.0, 1e-13);
}

TEST(EnergyGuard, CountsHeightAgainstGravityWhateverItsDirection) {
    PoseSet poses;
    poses.resize(1);
    const std::vector<SolverBody> bodies{{Vec2::Zero(), 0.0, 1.0 / 3.0, 50.0, false}};
    const Vec2 gravity{3.0, -8.0};
    poses.centre[0] = {1.0, 2.0};
    const double low = total_energy(bodies, poses, gravity, Parallel(1));
    poses.centre[0] -= 0.5 * unit(gravity);
    EXPECT_NEAR(total_energy(bodies, poses, gravity, Parallel(1)) - low, 3.0 * 0.5 * gravity.norm(), 1e-13);
    poses.centre[0] += left_normal(gravity);
    EXPECT_NEAR(total_energy(bodies, poses, gravity, Parallel(1)) - low, 3.0 * 0.5 * gravity.norm(), 1e-13) << "along";
}

TEST(EnergyGuard, FindsTheSameForGrainsInFreeFall) {
    std::vector<SolverBody> bodies = some_bodies(10, 3);
    PoseSet poses = somewhere(bodies.size(), 3);
    const Vec2 gravity{0.5, -9.81};
    const double before = total_energy(bodies, poses, gravity, Parallel(1));
    const double t = 0.4;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        poses.centre[k] += t * bodies[k].velocity + 0.5 * t * t * gravity;
        bodies[k].velocity += t * gravity;
    }
    EXPECT_NEAR(total_energy(bodies, poses, gravity, Parallel(1)), before, 1e-12 * before);
}

TEST(EnergyGuard, AddsUpToTheSameBitsOnAnyNumberOfThreads) {
    const std::vector<SolverBody> bodies = some_bodies(5000, 4);
    const PoseSet poses = somewhere(bodies.size(), 4);
    const double alone = total_energy(bodies, poses, {0.0, -9.81}, Parallel(1));
    EXPECT_EQ(total_energy(bodies, poses, {0.0, -9.81}, Parallel(3)), alone);
}

TEST(EnergyGuard, TakesExactlyTheExcessFromThoseThatTouched) {
    for (const double part : {1e-9, 0.1, 0.5, 0.999}) {
        const std::vector<SolverBody> before = some_bodies(9, 5);
        std::vector<SolverBody> after = before;
        const double available = kinetic(before, true);
        EXPECT_EQ(guard_energy(after, part * available), part * available);
        EXPECT_NEAR(kinetic(after, true), (1.0 - part) * available, 1e-13 * available) << "part " << part;
    }
}

TEST(EnergyGuard, ScalesAllThatTouchedByOneFactorAndNobodyElse) {
    const std::vector<SolverBody> before = some_bodies(9, 6);
    std::vector<SolverBody> after = before;
    guard_energy(after, 0.75 * kinetic(before, true));
    for (std::size_t k = 0; k < before.size(); ++k) {
        if (!before[k].touched) {
            EXPECT_TRUE(same_motion(after[k], before[k])) << "grain " << k;
            continue;
        }
        EXPECT_NEAR((after[k].velocity - 0.5 * before[k].velocity).norm(), 0.0, 1e-14) << "grain " << k;
        EXPECT_NEAR(after[k].spin, 0.5 * before[k].spin, 1e-12) << "grain " << k;
    }
}

TEST(EnergyGuard, DoesNothingWhereNothingWasCreated) {
    const std::vector<SolverBody> before = some_bodies(9, 7);
    for (const double excess : {0.0, -1e-12, -5.0}) {
        std::vector<SolverBody> after = before;
        EXPECT_EQ(guard_energy(after, excess), 0.0);
        for (std::size_t k = 0; k < before.size(); ++k) EXPECT_TRUE(same_motion(after[k], before[k]));
    }
}

TEST(EnergyGuard, StopsThoseThatTouchedWhereTheyHaveLessThanTheExcess) {
    const std::vector<SolverBody> before = some_bodies(9, 8);
    std::vector<SolverBody> after = before;
    EXPECT_EQ(guard_energy(after, 2.0 * kinetic(before, true)), kinetic(before, true));
    EXPECT_EQ(kinetic(after, true), 0.0);
    EXPECT_EQ(kinetic(after, false), kinetic(before, false));
}

TEST(EnergyGuard, TakesNothingWhereNobodyTouchedOrAllStand) {
    std::vector<SolverBody> flying = some_bodies(9, 9);
    for (SolverBody& body : flying) body.touched = false;
    const double energy = kinetic(flying, false);
    EXPECT_EQ(guard_energy(flying, 1.0), 0.0);
    EXPECT_EQ(kinetic(flying, false), energy);

    std::vector<SolverBody> standing = some_bodies(9, 9);
    for (SolverBody& body : standing) body.velocity = Vec2::Zero(), body.spin = 0.0;
    EXPECT_EQ(guard_energy(standing, 1.0), 0.0);
    EXPECT_EQ(kinetic(standing, true), 0.0);
}

}  // namespace
}  // namespace polargrain
