#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "src/core/random.h"

namespace polargrain {
namespace {

constexpr std::uint64_t k_seed = 20240611;

std::vector<std::uint64_t> first_words(RandomStream stream, int count) {
    std::vector<std::uint64_t> words;
    for (int n = 0; n < count; ++n) words.push_back(stream.bits());
    return words;
}

TEST(RandomStream, IsAFunctionOfItsNameAlone) {
    const RandomStream a(k_seed, RandomPurpose::test, 7, 3);
    EXPECT_EQ(first_words(a, 1000), first_words(RandomStream(k_seed, RandomPurpose::test, 7, 3), 1000));
}

TEST(RandomStream, MatchesPhiloxKnownAnswer) {
    // Key and counter zero: the published known answer of Philox 4x32-10 is 6627e8d5 e169c58d bc57ac4c 9b00dbd8.
    // A purpose is never zero, so the counter's last word is not either; this pins the stream as it is used.
    RandomStream stream(0, static_cast<RandomPurpose>(0), 0, 0);
    EXPECT_EQ(stream.bits(), 0xe169c58d6627e8d5ULL);
    EXPECT_EQ(stream.bits(), 0x9b00dbd8bc57ac4cULL);
}

TEST(RandomStream, EveryPartOfTheNameMakesAnotherStream) {
    const std::vector<std::vector<std::uint64_t>> streams{
        first_words(RandomStream(1, RandomPurpose::fill, 1, 1), 8),
        first_words(RandomStream(2, RandomPurpose::fill, 1, 1), 8),
        first_words(RandomStream(1ULL << 32, RandomPurpose::fill, 1, 1), 8),
        first_words(RandomStream(1, RandomPurpose::restitution, 1, 1), 8),
        first_words(RandomStream(1, RandomPurpose::fill, 2, 1), 8),
        first_words(RandomStream(1, RandomPurpose::fill, 1ULL << 32, 1), 8),
        first_words(RandomStream(1, RandomPurpose::fill, 1, 2), 8),
    };
    std::set<std::uint64_t> words;
    for (const auto& stream : streams) words.insert(stream.begin(), stream.end());
    EXPECT_EQ(words.size(), 8 * streams.size()) << "no word occurs twice";
}

TEST(RandomStream, UniformHasTheMomentsOfTheUniformDistribution) {
    RandomStream stream(k_seed, RandomPurpose::test);
    constexpr int n = 1'000'000;
    double sum = 0.0, squares = 0.0, products = 0.0, last = 0.5;
    for (int i = 0; i < n; ++i) {
        const double u = stream.uniform();
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        sum += u;
        squares += u * u;
        products += (u - 0.5) * (last - 0.5);
        last = u;
    }
    // Five standard deviations of each mean.
    EXPECT_NEAR(sum / n, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / n)) << "seed " << k_seed;
    EXPECT_NEAR(squares / n, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / n)) << "seed " << k_seed;
    EXPECT_NEAR(products / n, 0.0, 5.0 / 12.0 / std::sqrt(n)) << "neighbours are not correlated; seed " << k_seed;
}

TEST(RandomStream, UniformOnAnIntervalStaysInIt) {
    RandomStream stream(k_seed, RandomPurpose::test, 1);
    for (int i = 0; i < 10'000; ++i) {
        const double u = stream.uniform(-3.0, -2.0);
        ASSERT_GE(u, -3.0);
        ASSERT_LT(u, -2.0);
    }
}

TEST(RandomStream, NormalHasTheMomentsOfTheNormalDistribution) {
    RandomStream stream(k_seed, RandomPurpose::test, 2);
    constexpr int n = 1'000'000;
    double sum = 0.0, squares = 0.0, cubes = 0.0, fourths = 0.0;
    for (int i = 0; i < n; ++i) {
        const double x = stream.normal();
        sum += x;
        squares += x * x;
        cubes += x * x * x;
        fourths += x * x * x * x;
    }
    // Variances of x, x^2, x^3, x^4 under the normal law: 1, 2, 15, 96.
    EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(1.0 / n)) << "seed " << k_seed;
    EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n)) << "seed " << k_seed;
    EXPECT_NEAR(cubes / n, 0.0, 5.0 * std::sqrt(15.0 / n)) << "seed " << k_seed;
    EXPECT_NEAR(fourths / n, 3.0, 5.0 * std::sqrt(96.0 / n)) << "seed " << k_seed;
}

}  // namespace
}  // namespace polargrain
