#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "shapes/outline.h"
#include "src/core/error.h"
#include "tests/geometry/random_outline.h"

namespace polargrain::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::uint64_t k_seed = 971;

using Points = std::vector<Vec2>;

/// Neumaier's sum in long double: keeps what an addition loses.
class CompensatedSum {
public:
    void add(long double term) {
        const long double sum = sum_ + term;
        lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
        sum_ = sum;
    }
    long double value() const { return sum_ + lost_; }

private:
    long double sum_ = 0.0L, lost_ = 0.0L;
};

/// By triangles with the first point, each from its side vectors: another way than the one under test.
MassProperties by_triangles(const Points& points) {
    CompensatedSum area, first_x, first_y, second;
    const Vec2& o = points.front();
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        const long double ax = static_cast<long double>(points[k].x()) - o.x();
        const long double ay = static_cast<long double>(points[k].y()) - o.y();
        const long double bx = static_cast<long double>(points[k + 1].x()) - o.x();
        const long double by = static_cast<long double>(points[k + 1].y()) - o.y();
        const long double triangle = 0.5L * (ax * by - ay * bx);
        area.add(triangle);
        first_x.add(triangle * (ax + bx) / 3.0L);
        first_y.add(triangle * (ay + by) / 3.0L);
        second.add(triangle * (ax * ax + ay * ay + ax * bx + ay * by + bx * bx + by * by) / 6.0L);
    }
    const long double cx = first_x.value() / area.value();
    const long double cy = first_y.value() / area.value();
    const long double about_centroid = second.value() - area.value() * (cx * cx + cy * cy);
    return {static_cast<double>(std::abs(area.value())),
            {static_cast<double>(o.x() + cx), static_cast<double>(o.y() + cy)},
            static_cast<double>(std::abs(about_centroid))};
}

Points shifted(Points points, const Vec2& by) {
    for (Vec2& p : points) p += by;
    return points;
}

Points reversed(Points points) {
    std::reverse(points.begin(), points.end());
    return points;
}

template <typename Function>
std::string refusal(const Function& function, const Points& points) {
    try {
        (void)function("it", points);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string refusal(const Points& points) { return refusal(prepare_outline, points); }

const Points k_u_shape = {{0.0, 0.0}, {6.0, 0.0}, {6.0, 6.0}, {5.0, 6.0},
                          {5.0, 1.0}, {1.0, 1.0}, {1.0, 6.0}, {0.0, 6.0}};

TEST(MassProperties, OfARectangleAreThoseOfTheTextbook) {
    const auto mass = mass_properties("it", Points{{1.0, 2.0}, {4.0, 2.0}, {4.0, 4.0}, {1.0, 4.0}});
    EXPECT_EQ(mass.area, 6.0);
    EXPECT_EQ(mass.centroid, Vec2(2.5, 3.0));
    EXPECT_DOUBLE_EQ(mass.polar_moment, 6.0 * (9.0 + 4.0) / 12.0);
}

TEST(MassProperties, OfTwoBarsFollowTheParallelAxisTheorem) {
    // A vertical bar 1 x 4 and a horizontal one 5 x 1 in an L.
    const auto mass =
        mass_properties("it", Points{{0.0, 0.0}, {5.0, 0.0}, {5.0, 1.0}, {1.0, 1.0}, {1.0, 5.0}, {0.0, 5.0}});
    const Vec2 lower{2.5, 0.5}, upper{0.5, 3.0};
    const Vec2 centroid = (5.0 * lower + 4.0 * upper) / 9.0;
    const double moment = 5.0 * (25.0 + 1.0) / 12.0 + 5.0 * (lower - centroid).squaredNorm() +
                          4.0 * (16.0 + 1.0) / 12.0 + 4.0 * (upper - centroid).squaredNorm();
    EXPECT_DOUBLE_EQ(mass.area, 9.0);
    EXPECT_NEAR((mass.centroid - centroid).norm(), 0.0, 1e-15);
    EXPECT_NEAR(mass.polar_moment / moment, 1.0, 1e-15);
}

class RandomOutlines : public ::testing::TestWithParam<double> {};

TEST_P(RandomOutlines, AgreeWithAnIndependentCompensatedSum) {
    SCOPED_TRACE(fmt::format("seed {}", k_seed));
    const Vec2 offset{GetParam(), -0.7 * GetParam()};
    RandomStream random(k_seed, RandomPurpose::test);
    for (int k = 0; k < 1000; ++k) {
        const int vertices = 3 + static_cast<int>(random.uniform() * 60.0);
        const auto points = shifted(random_star_shaped(random, {vertices, 0.2, 1.0}), offset);
        const auto mass = mass_properties("it", points);
        const auto expected = by_triangles(points);
        ASSERT_NEAR(mass.area / expected.area, 1.0, 1e-12) << k;
        ASSERT_NEAR(mass.polar_moment / expected.polar_moment, 1.0, 1e-12) << k;
        ASSERT_NEAR((mass.centroid - expected.centroid).norm(), 0.0, 1e-15 * (1.0 + offset.norm())) << k;
        const auto backwards = mass_properties("it", reversed(points));
        ASSERT_EQ(backwards.area, mass.area);
        ASSERT_EQ(backwards.polar_moment, mass.polar_moment);
        ASSERT_EQ(backwards.centroid, mass.centroid);
    }
}

INSTANTIATE_TEST_SUITE_P(Offsets, RandomOutlines, ::testing::Values(0.0, 1.0, 1e3),
                         [](const auto& test) { return fmt::format("By{}m", test.param); });

// A millimetre grain drawn a kilometre from the origin, on a lattice of 2^-30 m on which the shift itself is exact.
TEST(PrepareOutline, IsNoWorseFarFromTheOrigin) {
    RandomStream random(k_seed, RandomPurpose::test);
    int prepared = 0;
    for (int k = 0; k < 100; ++k) {
        Points points = random_star_shaped(random, {24, 0.9, 0.9});
        for (Vec2& p : points) p = Vec2(std::round(p.x() * 0x1p20), std::round(p.y() * 0x1p20)) * 0x1p-30;
        if (!try_prepare_outline("it", points)) continue;
        ++prepared;
        const PolarPolygon near = prepare_outline("it", points);
        const PolarPolygon far = prepare_outline("it", shifted(points, {1024.0, -1024.0}));
        EXPECT_NEAR(far.area() / near.area(), 1.0, 1e-15);
        EXPECT_NEAR(far.polar_moment() / near.polar_moment(), 1.0, 1e-15);
        for (int q = 0; q < near.size(); ++q) {
            ASSERT_NEAR((far.vertex(q) - near.vertex(q)).norm() / near.outer_radius(), 0.0, 4e-16);
        }
    }
    EXPECT_GT(prepared, 30);
}

TEST(PrepareOutline, PutsTheCentroidAtTheOriginAndKeepsTheShape) {
    RandomStream random(k_seed, RandomPurpose::test);
    int prepared = 0;
    for (int k = 0; k < 300; ++k) {
        const auto points = shifted(random_star_shaped(random, {30, 0.6, 1.0}), {3.0, 4.0});
        const auto polygon = try_prepare_outline("it", points);
        if (!polygon) continue;
        ++prepared;
        const auto again = mass_properties("it", polygon->vertices());
        EXPECT_NEAR(again.centroid.norm(), 0.0, 1e-16 * 30.0);
        EXPECT_NEAR(again.area / polygon->area(), 1.0, 1e-14);
        EXPECT_NEAR(again.polar_moment / polygon->polar_moment(), 1.0, 1e-14);
        const Vec2 centroid = mass_properties("it", points).centroid;
        for (int q = 0; q < polygon->size(); ++q) {
            ASSERT_NEAR((polygon->vertex(q) + centroid - points[static_cast<std::size_t>(q)]).norm(), 0.0, 4e-15);
        }
    }
    EXPECT_GT(prepared, 150);
}

TEST(PrepareOutline, TurnsAClockwiseOutlineRound) {
    const Points square = {{-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}};
    const PolarPolygon polygon = prepare_outline("it", square);
    EXPECT_EQ(polygon.vertices(), reversed(square));
    EXPECT_EQ(polygon.area(), 4.0);
}

TEST(PrepareOutline, RefusesTooFewPointsRepeatedOnesAndWhatIsNoNumber) {
    const Points square = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    EXPECT_THAT(refusal({{0.0, 0.0}, {1.0, 0.0}}), HasSubstr("2 points: give at least 3"));
    EXPECT_THAT(refusal({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}), HasSubstr("point 2 repeats point 1"));
    Points closed = square;
    closed.push_back(square.front());
    EXPECT_THAT(refusal(closed), HasSubstr("the last point repeats the first"));
    Points undefined = square;
    undefined[3].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal(undefined), HasSubstr("point 3 is (0, nan)"));
    undefined[3].y() = std::numeric_limits<double>::infinity();
    EXPECT_THAT(refusal(undefined), HasSubstr("point 3 is (0, inf)"));
    EXPECT_THAT(refusal(Points(70000, Vec2(0.0, 0.0))), HasSubstr("give 65534 at most"));
}

TEST(PrepareOutline, NamesTheEdgesThatCross) {
    const Points uneven_bow_tie = {{0.0, 0.0}, {2.0, 2.0}, {2.0, 0.0}, {0.0, 1.0}};
    const Points bow_tie_of_no_area = {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}};
    const Points spike = {{0.0, 0.0}, {4.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}};
    const Points flat = {{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}};
    const Points touching = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {2.0, 0.0}, {0.0, 4.0}};
    Points pentagram;  // every sector goes forward, but twice round
    for (int k = 0; k < 5; ++k) {
        const auto [s, c] = sine_cosine(4.0 * k_pi * k / 5);
        pentagram.emplace_back(c, s);
    }
    const auto meets = [](const char* a, const char* b) {
        return HasSubstr(fmt::format("edge {} meets edge {}", a, b));
    };
    for (const auto& function : {+[](const std::string&n, const Points&p) { (void)prepare_outline(n, p); },
                                 +[](const std::string&n, const Points&p) { (void)mass_properties(n, p); }}) {
        EXPECT_THAT(refusal(function, uneven_bow_tie), meets("0-1", "2-3"));
        EXPECT_THAT(refusal(function, bow_tie_of_no_area), meets("0-1", "2-3"));
        EXPECT_THAT(refusal(function, spike), meets("0-1", "1-2"));
        EXPECT_THAT(refusal(function, flat), HasSubstr("crosses or touches itself"));
        EXPECT_THAT(refusal(function, touching), meets("0-1", "2-3"));
        EXPECT_THAT(refusal(function, pentagram), meets("0-1", "2-3"));
    }
}

// Seen from the centroid (3, 2.375) in the hollow of the U, the edge from (5, 6) down to (5, 1) runs backwards.
TEST(PrepareOutline, NamesTheVertexThatTurnsBackAsItWasGiven) {
    EXPECT_THAT(refusal(k_u_shape), AllOf(HasSubstr("vertex 4 "), HasSubstr("at (5, 1) turns back")));
    EXPECT_THAT(refusal(reversed(k_u_shape)), AllOf(HasSubstr("vertex 3 "), HasSubstr("at (5, 1) turns back")));
    EXPECT_EQ(try_prepare_outline("it", k_u_shape), std::nullopt);
    EXPECT_DOUBLE_EQ(mass_properties("it", k_u_shape).area, 16.0);
}

TEST(PrepareOutline, TakesDeeplyHollowOutlinesAsLongAsEverySectorGoesForward) {
    Points star;
    for (int k = 0; k < 16; ++k) {
        const auto [s, c] = sine_cosine(2.0 * k_pi * k / 16);
        star.emplace_back((k % 2 == 0 ? 1.0 : 0.01) * Vec2(c, s));
    }
    const PolarPolygon polygon = prepare_outline("it", star);
    EXPECT_LE(polygon.inner_radius(), 0.01);
    EXPECT_NEAR(polygon.area(), 8.0 * 0.01 * std::sin(k_pi / 8.0), 1e-15);
}

TEST(PrepareOutline, RefusesSizesThatNoNumberCanHold) {
    for (const double size : {1e-100, 1e100}) {
        EXPECT_THAT(refusal({{0.0, 0.0}, {size, 0.0}, {0.0, size}}), HasSubstr("check the unit")) << size;
    }
}

}  // namespace
}  // namespace polargrain::testing
