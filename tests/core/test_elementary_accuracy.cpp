#include <gtest/gtest.h>

#include <cmath>

#include "src/core/elementary.h"
#include "src/core/random.h"

namespace polargrain {
namespace {

constexpr std::uint64_t k_seed = 4711;
constexpr int k_points = 1'000'000;

/// Distance of a value from the truth in units of the last place of the truth.
double ulps(double value, long double truth) {
    const double rounded = std::abs(static_cast<double>(truth));
    const long double ulp = std::nextafter(rounded, INFINITY) - rounded;
    return static_cast<double>(std::abs(static_cast<long double>(value) - truth) / ulp);
}

TEST(SineCosine, AreWithinTwoUnitsOfTheLastPlaceOfTheTruth) {
    RandomStream random(k_seed, RandomPurpose::test);
    double worst = 0.0, worst_angle = 0.0;
    for (int n = 0; n < k_points; ++n) {
        // Small and large angles alike: the magnitude is spread over eight decades.
        const double angle = random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-3.0, 5.0));
        const auto [sine, cosine] = sine_cosine(angle);
        const double error = std::max(ulps(sine, std::sin(static_cast<long double>(angle))),
                                      ulps(cosine, std::cos(static_cast<long double>(angle))));
        if (error > worst) worst = error, worst_angle = angle;
    }
    EXPECT_LT(worst, 2.0) << "at the angle " << worst_angle << ", seed " << k_seed;
}

TEST(SineCosine, AreExactAtZeroAndOddAndEven) {
    EXPECT_EQ(sine_cosine(0.0).sine, 0.0);
    EXPECT_EQ(sine_cosine(0.0).cosine, 1.0);
    RandomStream random(k_seed, RandomPurpose::test, 1);
    for (int n = 0; n < 10'000; ++n) {
        const double angle = random.uniform(0.0, 100.0);
        ASSERT_EQ(sine_cosine(-angle).sine, -sine_cosine(angle).sine) << angle;
        ASSERT_EQ(sine_cosine(-angle).cosine, sine_cosine(angle).cosine) << angle;
    }
}

TEST(NaturalLog, IsWithinTwoUnitsOfTheLastPlaceOfTheTruth) {
    RandomStream random(k_seed, RandomPurpose::test, 2);
    double worst = 0.0, worst_x = 0.0;
    for (int n = 0; n < k_points; ++n) {
        const double x = std::pow(10.0, random.uniform(-300.0, 300.0));
        const double near_one = random.uniform(0.5, 2.0);
        for (const double value : {x, near_one}) {
            const double error = ulps(natural_log(value), std::log(static_cast<long double>(value)));
            if (error > worst) worst = error, worst_x = value;
        }
    }
    EXPECT_LT(worst, 2.0) << "at " << worst_x << ", seed " << k_seed;
}

TEST(Exponential, IsWithinTwoUnitsOfTheLastPlaceOfTheTruth) {
    RandomStream random(k_seed, RandomPurpose::test, 3);
    double worst = 0.0, worst_x = 0.0;
    for (int n = 0; n < k_points; ++n) {
        const double x = random.uniform(-1.0, 1.0) * (n % 2 == 0 ? 700.0 : 1.0);
        const double error = ulps(exponential(x), std::exp(static_cast<long double>(x)));
        if (error > worst) worst = error, worst_x = x;
    }
    EXPECT_LT(worst, 2.0) << "at " << worst_x << ", seed " << k_seed;
}

}  // namespace
}  // namespace polargrain
