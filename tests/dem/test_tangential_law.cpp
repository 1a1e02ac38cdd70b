#include <gtest/gtest.h>

#include <cmath>

#include "src/engines/dem/tangential_law.h"

namespace polargrain {
namespace {

TEST(SpringSlider, HoldsUpToTheLimitAndThenSlipsAtIt) {
    constexpr double k = 1000.0;
    constexpr double limit = 2.0;
    const Tangential holds = spring_slider(1e-3, k, 0.0, 0.0, limit);
    EXPECT_DOUBLE_EQ(holds.force, -1.0);
    EXPECT_DOUBLE_EQ(holds.stretch, 1e-3);
    EXPECT_DOUBLE_EQ(holds.energy, 0.5e-3);
    const Tangential slips = spring_slider(5e-3, k, 0.0, 0.0, limit);
    EXPECT_DOUBLE_EQ(slips.force, -limit);
    EXPECT_DOUBLE_EQ(slips.stretch, limit / k);
    EXPECT_DOUBLE_EQ(spring_slider(slips.stretch, k, 0.0, 0.0, limit).force, -limit);
}

TEST(SpringSlider, DampsAgainstTheSlidingWithinTheLimit) {
    EXPECT_DOUBLE_EQ(spring_slider(1e-3, 1000.0, 5.0, 0.1, 10.0).force, -1.5);
    EXPECT_DOUBLE_EQ(spring_slider(1e-3, 1000.0, 5.0, -0.3, 10.0).force, 0.5);
}

TEST(SpringSlider, LetsTheDashpotStretchNothing) {
    const Tangential t = spring_slider(1e-3, 1000.0, 50.0, 1.0, 2.0);
    EXPECT_DOUBLE_EQ(t.force, -2.0);
    EXPECT_DOUBLE_EQ(t.stretch, 1e-3);
}

TEST(SpringSlider, WithoutFrictionKeepsAndDoesNothing) {
    const Tangential t = spring_slider(1e-3, 1000.0, 5.0, 0.1, 0.0);
    EXPECT_DOUBLE_EQ(std::abs(t.force), 0.0);
    EXPECT_DOUBLE_EQ(std::abs(t.stretch), 0.0);
}

TEST(SpringSlider, TakesOnAClosedPathTheWorkOfCoulombsForceOnTheWayItSlips) {
    // There and back twice by 10 mm: of the four ways the spring takes 2 mm of the first and 4 mm after each turn.
    constexpr double k = 1000.0;
    constexpr double limit = 2.0;
    double stretch = 0.0;
    double work = 0.0;
    const int n = 20000;
    for (int step = 0; step < 4 * n; ++step) {
        const double way = (step / n % 2 == 0 ? 1.0 : -1.0) * 1e-2 / n;
        const Tangential t = spring_slider(stretch + way, k, 0.0, 0.0, limit);
        work -= t.force * way;
        stretch = t.stretch;
    }
    EXPECT_NEAR(work - 0.5 * k * stretch * stretch, limit * (0.04 - 0.002 - 3 * 0.004), 1e-5);
}

TEST(ViscousSlider, IsCoulombsBeyondAndViscousBelowTheLimit) {
    EXPECT_DOUBLE_EQ(viscous_slider(5.0, 0.1, 2.0).force, -0.5);
    EXPECT_DOUBLE_EQ(viscous_slider(5.0, -10.0, 2.0).force, 2.0);
}

TEST(IncrementalTangential, LoadsAsTheClosedFormSays) {
    // T = mu N [1 - (1 - 2 k0 s / (3 mu N))^(3/2)].
    constexpr double k0 = 1e5;
    constexpr double normal = 10.0;
    constexpr double mu = 0.4;
    for (const int steps : {1, 7, 1000}) {
        IncrementalMemory t;
        for (const double way : {1e-6, 1e-5, 3e-5}) {
            t = {};
            for (int k = 0; k < steps; ++k) t = walton_braun_tangential(t, way / steps, k0, normal, mu);
            const double exact = mu * normal * (1.0 - std::pow(1.0 - 2.0 * k0 * way / (3.0 * mu * normal), 1.5));
            EXPECT_NEAR(t.force / exact, 1.0, 1e-10);
            EXPECT_LT(t.force, mu * normal);
        }
        EXPECT_NEAR(walton_braun_tangential(t, 1.0, k0, normal, mu).force, mu * normal, 1e-12);
    }
}

TEST(IncrementalTangential, TurnsWithTheInitialStiffnessAndComesBackToTheTurningPoint) {
    constexpr double k0 = 1e5;
    constexpr double normal = 10.0;
    constexpr double mu = 0.4;
    IncrementalMemory t = walton_braun_tangential({}, 2e-5, k0, normal, mu);
    const double top = t.force;
    const IncrementalMemory turned = walton_braun_tangential(t, -1e-9, k0, normal, mu);
    EXPECT_NEAR((top - turned.force) / 1e-9, k0, 1e-3 * k0);
    EXPECT_DOUBLE_EQ(turned.turning, top);
    t = walton_braun_tangential(turned, -10.0, k0, normal, mu);
    EXPECT_NEAR(t.force, -mu * normal, 1e-12);
}

TEST(IncrementalTangential, ScalesItsTurningPointWithTheNormalForce) {
    const IncrementalMemory before{1.0, 2.0, 10.0};
    const IncrementalMemory now = walton_braun_tangential(before, 0.0, 1e5, 5.0, 0.5);
    EXPECT_DOUBLE_EQ(now.turning, 1.0);
    EXPECT_DOUBLE_EQ(walton_braun_tangential(before, 0.0, 1e5, 0.0, 0.5).force, 0.0);
}

}  // namespace
}  // namespace polargrain
