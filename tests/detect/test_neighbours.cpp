#include <gtest/gtest.h>

#include <cmath>

#include "src/core/random.h"
#include "src/detect/pair_list.h"

namespace polargrain {
namespace {

std::vector<GrainPair> all_pairs(const std::vector<BoundingCircle>& circles) {
    std::vector<GrainPair> pairs;
    for (std::size_t a = 0; a < circles.size(); ++a) {
        for (std::size_t b = a + 1; b < circles.size(); ++b) {
            const double reach = circles[a].radius + circles[b].radius;
            if ((circles[a].centre - circles[b].centre).squaredNorm() < reach * reach) {
                pairs.emplace_back(static_cast<GrainIndex>(a), static_cast<GrainIndex>(b));
            }
        }
    }
    return pairs;
}

std::vector<BoundingCircle> random_circles(RandomStream& random, int n, double spread, const Vec2& origin) {
    std::vector<BoundingCircle> circles;
    for (int k = 0; k < n; ++k) {
        const double radius = 0.01 * std::pow(spread, random.uniform());
        circles.push_back({origin + Vec2(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)), radius});
    }
    return circles;
}

TEST(NeighbourSearch, FindsExactlyThePairsOfAllPairsChecking) {
    RandomStream random(51, RandomPurpose::test);
    NeighbourSearch search;
    std::vector<GrainPair> pairs;
    for (const double spread : {1.0, 2.0, 7.3, 100.0}) {
        for (const Vec2& origin : {Vec2(0.0, 0.0), Vec2(-1e4, 3e5)}) {
            for (int scene = 0; scene < 20; ++scene) {
                const auto circles = random_circles(random, 1 + scene * 12, spread, origin);
                search.find_pairs(circles, pairs);
                ASSERT_EQ(pairs, all_pairs(circles)) << "seed 51, spread " << spread << ", scene " << scene;
            }
        }
    }
}

TEST(NeighbourSearch, RenewsThePairsOfThoseThatHaveChanged) {
    RandomStream random(53, RandomPurpose::test);
    NeighbourSearch search(2);
    std::vector<GrainPair> pairs;
    for (const double spread : {1.0, 7.3, 100.0, 3000.0}) {
        auto circles = random_circles(random, 400, spread, Vec2(-7.0, 3.0));
        search.find_pairs(circles, pairs);
        for (int round = 0; round < 40; ++round) {
            std::vector<GrainIndex> changed;
            for (std::size_t k = 0; k < circles.size(); ++k) {
                if (random.uniform() > 0.02) continue;
                changed.push_back(static_cast<GrainIndex>(k));
                circles[k] = random_circles(random, 1, spread, Vec2(-7.0, 3.0)).front();
                circles[k].radius *= random.uniform(0.3, 3.0);
            }
            search.renew_pairs(circles, changed, pairs);
            ASSERT_EQ(pairs, all_pairs(circles)) << "seed 53, spread " << spread << ", round " << round;
        }
        EXPECT_GT(search.loose(), 100U) << "some change twice";
    }
}

std::vector<Pose> poses_at(const std::vector<Vec2>& centres) {
    std::vector<Pose> poses;
    for (const Vec2& c : centres) poses.push_back(Pose::at(c, 0.0));
    return poses;
}

/// 200 grains shaken for 300 steps, and so many of them faster than the others; checks the list at both ends of every
/// step, and returns how often it has changed.
int shake(std::uint64_t seed, std::size_t fast) {
    RandomStream random(seed, RandomPurpose::test);
    std::vector<double> radii;
    std::vector<Vec2> centres;
    for (int k = 0; k < 200; ++k) {
        radii.push_back(random.uniform(0.005, 0.03));
        centres.emplace_back(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    }
    PairList list(radii);
    int changes = 0;
    for (int step = 0; step < 300; ++step) {
        std::vector<Vec2> next = centres;
        for (std::size_t k = 0; k < next.size(); ++k) {
            const double way = step % 50 == 0 || k < fast ? 0.01 : 1e-4;
            next[k] += Vec2(random.normal(), random.normal()) * way;
        }
        changes += list.update(poses_at(centres), poses_at(next)) ? 1 : 0;
        for (const auto* at : {&centres, &next}) {
            std::vector<BoundingCircle> circles;
            for (std::size_t k = 0; k < radii.size(); ++k) circles.push_back({(*at)[k], radii[k]});
            for (const GrainPair& pair : all_pairs(circles)) {
                EXPECT_TRUE(std::binary_search(list.pairs().begin(), list.pairs().end(), pair)) << "step " << step;
            }
        }
        centres = next;
    }
    return changes;
}

TEST(PairList, NeverMissesAPairThatMeetsOnTheWay) {
    EXPECT_LT(shake(52, 0), 100) << "the list is kept over steps";
    EXPECT_GT(shake(54, 3), 20) << "a few fast grains have theirs found anew";
}

}  // namespace
}  // namespace polargrain
