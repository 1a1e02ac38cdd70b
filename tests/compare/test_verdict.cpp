#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "src/compare/verdict.h"
#include "src/core/random.h"

namespace polargrain {
namespace {

using ::testing::HasSubstr;

Spread of(const std::vector<double>& values) { return spread_of(values); }

TEST(Spread, IsMeanAndSampleDeviation) {
    const Spread s = of({2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
    EXPECT_DOUBLE_EQ(s.mean, 5.0);
    EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(32.0 / 7.0));
    const Spread with_gap = of({1.0, std::numeric_limits<double>::quiet_NaN(), 3.0});
    EXPECT_EQ(with_gap.count, 2);
    EXPECT_DOUBLE_EQ(with_gap.mean, 2.0);
    EXPECT_EQ(of({}).count, 0);
}

TEST(Verdict, KnowsWelchsTest) {
    // Example worked by hand: t = 2 / sqrt(1/4 + 4/4) = 1.789 with 4.41 degrees of freedom; 5 % point for 4: 2.776.
    const Spread a{4, 10.0, 1.0};
    EXPECT_EQ(compare_means(a, {4, 12.0, 2.0}).agreement, Agreement::within_spread);
    // 3.2 / 1.118 = 2.862 lies beyond it.
    const Verdict apart = compare_means(a, {4, 13.2, 2.0});
    EXPECT_EQ(apart.agreement, Agreement::differs);
    EXPECT_DOUBLE_EQ(apart.relative, 0.32);
}

TEST(Verdict, RejectsEqualPopulationsOnceInTwenty) {
    RandomStream random(1, RandomPurpose::test);
    int rejected = 0;
    const int trials = 4000;
    for (int k = 0; k < trials; ++k) {
        std::vector<double> a, b;
        for (int n = 0; n < 8; ++n) {
            a.push_back(5.0 + random.normal());
            b.push_back(5.0 + 3.0 * random.normal());
        }
        if (compare_means(of(a), of(b)).agreement == Agreement::differs) ++rejected;
    }
    EXPECT_NEAR(static_cast<double>(rejected) / trials, 0.05, 0.012);
}

TEST(Verdict, WithoutSpreadIsPlain) {
    EXPECT_EQ(compare_means(of({0.0, 0.0}), of({0.0, 0.0})).agreement, Agreement::same);
    EXPECT_EQ(compare_means(of({1.0, 1.0}), of({1.0005, 1.0005})).agreement, Agreement::same);
    EXPECT_EQ(compare_means(of({1.0, 1.0}), of({1.01, 1.01})).agreement, Agreement::differs);
    EXPECT_EQ(compare_means(of({1.0}), of({1.01})).agreement, Agreement::single);
    EXPECT_EQ(compare_means(of({}), of({1.0})).agreement, Agreement::unknown);
}

TEST(Verdict, ReadsAsASentence) {
    EXPECT_EQ(to_string(compare_means(of({1.0, 1.0}), of({1.1, 1.1})), "m"), "differs by +0.1 m (+10 %)");
    EXPECT_EQ(to_string(compare_means(of({0.0, 0.0}), of({3.0, 3.0})), ""), "differs by +3");
    EXPECT_THAT(to_string(compare_means(of({1.0}), of({2.0})), ""), HasSubstr("one run only"));
    EXPECT_EQ(to_string(Spread{5, 1.23456, 0.0123}), "1.235 +- 0.012");
    EXPECT_EQ(to_string(Spread{5, 1.23456, 0.0}), "1.235");
}

}  // namespace
}  // namespace polargrain
