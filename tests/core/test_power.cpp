#include <gtest/gtest.h>

#include <cmath>

#include "src/core/elementary.h"
#include "src/core/random.h"

namespace polargrain {
namespace {

TEST(Power, IsAsCloseToTheTruthAsPromised) {
    RandomStream random(90210, RandomPurpose::test);
    for (int n = 0; n < 200'000; ++n) {
        const double base = std::pow(10.0, random.uniform(-8.0, 2.0));
        const double exponent = random.uniform(-30.0, 30.0);
        const long double truth = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
        const double allowed = 4e-16 * (1.0 + std::abs(exponent * std::log(base)));
        const double error = static_cast<double>(static_cast<long double>(power(base, exponent)) / truth - 1.0L);
        ASSERT_LT(std::abs(error), allowed) << base << " to the " << exponent << ", seed 90210";
    }
}

TEST(Power, KeepsOneAndTheZerothPower) {
    EXPECT_EQ(power(1.0, 17.5), 1.0);
    EXPECT_EQ(power(0.3, 0.0), 1.0);
    EXPECT_EQ(exponential(0.0), 1.0);
}

}  // namespace
}  // namespace polargrain
