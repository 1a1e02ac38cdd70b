#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/core/random.h"
#include "src/detect/wall_search.h"

namespace polargrain {
namespace {

double distance(const WallPiece& piece, const Vec2& point) {
    const Vec2 along = piece.b - piece.a;
    const double length2 = along.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp((point - piece.a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return std::sqrt((piece.a + s * along - point).squaredNorm());
}

bool box_meets(const WallPiece& piece, const Vec2& point, double reach) {
    const Vec2 low = piece.a.cwiseMin(piece.b) - point;
    const Vec2 high = piece.a.cwiseMax(piece.b) - point;
    return low.maxCoeff() <= reach && high.minCoeff() >= -reach;
}

Vec2 random_point(RandomStream& random, double size) {
    const double x = random.uniform(-size, size);
    return {x, random.uniform(-size, size)};
}

WallMotion random_motion(RandomStream& random) {
    const double kind = random.uniform(0.0, 3.0);
    if (kind < 1.0) return {};
    if (kind < 2.0) return SineMotion{unit(random_point(random, 1.0)), random.uniform(0.0, 0.05), 20.0, 0.0};
    return RotationMotion{random_point(random, 0.5), random.uniform(-5.0, 5.0), 0.1};
}

/// Chains of short and long pieces here and there; some pieces are points, some walls far away, some go.
std::vector<Wall> random_walls(RandomStream& random, int count) {
    std::vector<Wall> walls;
    for (int w = 0; w < count; ++w) {
        Wall wall;
        wall.points = {random_point(random, 0.5)};
        if (random.uniform() < 0.05) wall.points.front() += Vec2(1e6, -3e5);
        const auto pieces = static_cast<int>(random.uniform(1.0, 40.0));
        const double length = 0.3 * std::pow(1e-3, random.uniform());
        for (int k = 0; k < pieces; ++k) {
            const bool point = random.uniform() < 0.05;
            const Vec2 last = wall.points.back();
            wall.points.push_back(point ? last : Vec2(last + random_point(random, length)));
        }
        wall.motion = random_motion(random);
        if (random.uniform() < 0.2) wall.remove_at = random.uniform(0.0, 2.0);
        walls.push_back(std::move(wall));
    }
    return walls;
}

class WallSearchAgainstAll : public ::testing::TestWithParam<int> {};

// Walls shake, turn and go; one search is taken through all times.
TEST_P(WallSearchAgainstAll, FindsEveryPieceInReachAndNoneWhoseBoxIsNot) {
    const auto seed = static_cast<std::uint64_t>(GetParam());
    RandomStream random(seed, RandomPurpose::test);
    for (const int count : {0, 1, 2, 5, 30}) {
        const std::vector<Wall> walls = random_walls(random, count);
        WallSearch search;
        std::vector<PlacedPiece> pieces;
        std::vector<std::int32_t> near;
        for (const double time : {0.0, 0.03, 0.7, 1.9, 0.7, 25.0}) {
            place_pieces(walls, time, pieces);
            search.place(pieces);
            for (int draw = 0; draw < 300; ++draw) {
                const Vec2 centre = draw % 10 > 0 || pieces.empty() ? random_point(random, 0.6) : pieces.back().piece.a;
                const double reach = std::pow(1e-4, random.uniform());
                search.find(centre, reach, near);
                ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
                for (std::size_t k = 0; k < pieces.size(); ++k) {
                    const auto number = static_cast<std::int32_t>(k);
                    const bool found = std::binary_search(near.begin(), near.end(), number);
                    const WallPiece& piece = pieces[k].piece;
                    ASSERT_TRUE(found || distance(piece, centre) > reach)
                        << "seed " << seed << ", " << count << " walls, time " << time << ", missed " << number;
                    ASSERT_TRUE(!found ||
                                box_meets(piece, centre, reach + 1e-6 * (reach + 0.01 * centre.cwiseAbs().maxCoeff())))
                        << "seed " << seed << ", " << count << " walls, time " << time << ", too many " << number;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, WallSearchAgainstAll, ::testing::Range(61, 69));

TEST(WallSearch, StopsAtTheFirstPieceThatWillDo) {
    std::vector<PlacedPiece> pieces;
    for (int k = 0; k < 100; ++k) pieces.push_back({{{0.01 * k, 0.0}, {0.01 * k + 0.01, 0.0}}, 0, k});
    WallSearch search;
    search.place(pieces);
    int looks = 0;
    EXPECT_TRUE(search.any_near({0.5, 0.0}, 0.2, [&looks](std::int32_t) { return ++looks == 3; }));
    EXPECT_EQ(looks, 3);
    EXPECT_FALSE(search.any_near({0.5, 0.3}, 0.2, [&looks](std::int32_t) { return ++looks > 0; }));
    EXPECT_EQ(looks, 3);
}

/// A closed drum of n segments.
std::vector<PlacedPiece> drum(int n, double radius) {
    Wall wall;
    for (int k = 0; k <= n; ++k) {
        const double angle = 2.0 * k_pi * (k % n) / n;
        wall.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    std::vector<PlacedPiece> pieces;
    place_pieces(std::vector<Wall>{wall}, 0.0, pieces);
    return pieces;
}

/// Candidates of all of 1000 grains in a circle.
std::size_t candidates(const std::vector<PlacedPiece>& pieces, double circle, double reach) {
    WallSearch search;
    search.place(pieces);
    RandomStream random(70, RandomPurpose::test);
    std::vector<std::int32_t> near;
    std::size_t sum = 0;
    for (int grain = 0; grain < 1000; ++grain) {
        const double from_centre = circle * std::sqrt(random.uniform());
        const double angle = random.uniform(-k_pi, k_pi);
        search.find(from_centre * Vec2(std::cos(angle), std::sin(angle)), reach, near);
        sum += near.size();
    }
    return sum;
}

// A finer drum has more pieces within a grain's reach, but a grain has no more to do with the rest of it.
TEST(WallSearch, GivesAGrainNoMorePiecesThanLieByItHoweverManyThereAre) {
    for (const int n : {50, 200, 800, 3200, 50000}) {
        const double segment = 2.0 * k_pi * 0.3 / n;
        const double reach = 2.0 * segment;
        const double on_the_wall = 0.3;
        EXPECT_EQ(candidates(drum(n, 0.3), on_the_wall - 0.01 - 2.0 * reach, reach), 0U) << n << " segments";
        EXPECT_LE(candidates(drum(n, 0.3), on_the_wall, reach), 1000 * 9U) << n << " segments";
    }
}

}  // namespace
}  // namespace polargrain
