#include <gtest/gtest.h>

#include <cmath>

#include "src/core/random.h"
#include "src/engines/dem/pair_search.h"

namespace polargrain {
namespace {

/// Circles spread over a box that holds about `fill` of its area in circles; radii by the given ratio, log-uniform.
std::vector<BoundingCircle> random_circles(int n, double ratio, double fill, std::uint64_t seed) {
    RandomStream random(seed, RandomPurpose::test);
    std::vector<BoundingCircle> circles;
    double area = 0.0;
    for (int k = 0; k < n; ++k) {
        const double r = std::pow(ratio, random.uniform());
        circles.push_back({Vec2::Zero(), r});
        area += 3.14159 * r * r;
    }
    const double side = std::sqrt(area / fill);
    for (auto& c : circles) c.centre = {random.uniform(-side, 0.2 * side), random.uniform(3.0 * side, 4.2 * side)};
    return circles;
}

struct Case {
    int n;
    double ratio;
    double fill;
};

class EveryPairSearch : public ::testing::TestWithParam<Case> {};

TEST_P(EveryPairSearch, FindsThePairsOfDirectChecking) {
    const auto& [n, ratio, fill] = GetParam();
    PairFinder verlet(PairSearch::verlet);
    PairFinder nbs(PairSearch::nbs);
    PairFinder cgrid(PairSearch::cgrid);
    PairFinder direct(PairSearch::direct);
    std::vector<GrainPair> expected;
    std::vector<GrainPair> found;
    std::size_t total = 0;
    // The finders keep their memory, so each scene after the first also meets what the one before has left there.
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto circles = random_circles(n, ratio, fill, seed);
        direct.find_pairs(circles, expected);
        for (PairFinder* finder : {&verlet, &nbs, &cgrid}) {
            finder->find_pairs(circles, found);
            EXPECT_EQ(found, expected) << "seed " << seed;
        }
        total += expected.size();
    }
    EXPECT_EQ(total > 0, n > 1);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryPairSearch,
                         ::testing::Values(Case{1, 1.0, 0.3}, Case{2, 1.0, 3.0}, Case{300, 1.0, 0.5},
                                           Case{1200, 3.0, 0.8}, Case{1000, 100.0, 0.7}, Case{300, 1.0, 0.05}));

TEST(NbsSearch, BearsAGrainThatHasFlownFarAway) {
    auto circles = random_circles(200, 2.0, 0.6, 9);
    circles[17].centre = {1e9, -1e9};
    std::vector<GrainPair> expected;
    std::vector<GrainPair> found;
    find_pairs_directly(circles, expected);
    NbsSearch().find_pairs(circles, found);
    EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace polargrain
