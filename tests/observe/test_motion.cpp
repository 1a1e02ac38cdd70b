#include <gtest/gtest.h>

#include <cmath>

#include "src/core/random.h"
#include "src/observe/motion.h"
#include "tests/observe/observed.h"

namespace polargrain::testing {
namespace {

TEST(GranularTemperature, OfNormalVelocitiesIsTheirVariance) {
    constexpr double k_spread = 0.3;
    RandomStream random(7, RandomPurpose::test);
    Scene scene = disks_at(std::vector<Vec2>(20000, Vec2::Zero()));
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        scene.grains.set_velocity(k, Vec2(5.0, -2.0) + k_spread * Vec2(random.normal(), random.normal()));
    }
    const double temperature = granular_temperature(scene.grains, all_of(scene));
    // The variance of a mean of 2 n squares is 2 T^2 / 2 n.
    EXPECT_NEAR(temperature, k_spread * k_spread, 4.0 * k_spread * k_spread / std::sqrt(20000.0));
    EXPECT_NEAR(mean_velocity(scene.grains, all_of(scene)).x(), 5.0, 4.0 * k_spread / std::sqrt(20000.0));
}

TEST(GranularTemperature, OfABodyOfGrainsThatMoveAsOneIsZero) {
    Scene scene = disks_at({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}});
    for (GrainIndex k = 0; k < 3; ++k) scene.grains.set_velocity(k, {3.0, 4.0});
    EXPECT_NEAR(granular_temperature(scene.grains, all_of(scene)), 0.0, 1e-28);
}

TEST(CentreOfMass, WeighsByMassAndKeepsToRegionAndKind) {
    Scene scene = disks_at({{0.0, 0.0}, {1.0, 0.0}, {10.0, 4.0}});
    scene.grains.mass = {1.0, 3.0, 1.0};
    EXPECT_DOUBLE_EQ(centre_of_mass(scene.grains, all_of(scene), Region{{-1.0, -1.0}, {2.0, 1.0}}).x(), 0.75);
    EXPECT_DOUBLE_EQ(centre_of_mass(scene.grains, {0, 0, 1}).y(), 4.0);
    EXPECT_TRUE(std::isnan(centre_of_mass(scene.grains, {0, 0, 0}).x()));
}

TEST(KineticEnergyPerGrain, CountsSpin) {
    Scene scene = disks_at({{0.0, 0.0}, {1.0, 0.0}});
    scene.grains.set_velocity(0, {3.0, 4.0});
    scene.grains.spin[1] = 2.0;
    const double expected = 0.5 * (0.5 * scene.grains.mass[0] * 25.0 + 0.5 * scene.grains.inertia[1] * 4.0);
    EXPECT_DOUBLE_EQ(kinetic_energy_per_grain(scene.grains, all_of(scene)), expected);
}

}  // namespace
}  // namespace polargrain::testing
