#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/error.h"
#include "src/geometry/polar_polygon.h"
#include "tests/geometry/random_outline.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t k_seed = 20240117;
const MassProperties k_any_mass{.area = 1.0, .centroid = Vec2::Zero(), .polar_moment = 1.0};

// Sign of cross(a, p) with the 64 bits of long double.
long double wide_cross(const Vec2& a, const Vec2& p) {
    return static_cast<long double>(a.x()) * static_cast<long double>(p.y()) -
           static_cast<long double>(a.y()) * static_cast<long double>(p.x());
}

bool sector_holds(const PolarPolygon& polygon, int q, const Vec2& p) {
    return wide_cross(polygon.vertex(q), p) >= 0.0L && wide_cross(polygon.vertex(polygon.next(q)), p) < 0.0L;
}

int sector_by_search(const PolarPolygon& polygon, const Vec2& p) {
    for (int q = 0; q < polygon.size(); ++q) {
        if (sector_holds(polygon, q, p)) return q;
    }
    return -1;
}

class RandomPolygons : public ::testing::TestWithParam<OutlineStyle> {
protected:
    RandomStream random_{k_seed, RandomPurpose::test};

    PolarPolygon draw() { return {"random", random_star_shaped(random_, GetParam()), k_any_mass}; }
    Vec2 point(double reach) { return {random_.uniform(-reach, reach), random_.uniform(-reach, reach)}; }
};

TEST_P(RandomPolygons, PointsOutsideAreAsFarAwayAsTheEvennessSays) {
    SCOPED_TRACE(fmt::format("seed {}", k_seed));
    for (int shape = 0; shape < 20; ++shape) {
        const PolarPolygon polygon = draw();
        for (int k = 0; k < 500; ++k) {
            const Vec2 p = point(1.3);
            const double gap = -polygon.depth(p);
            if (gap <= 0.0) continue;
            double away = 1e9;
            for (int q = 0; q < polygon.size(); ++q) {
                away = std::min(away, distance(p, polygon.vertex(q), polygon.vertex(polygon.next(q))));
            }
            ASSERT_GE(away, polygon.evenness() * gap * (1.0 - 1e-12)) << "shape " << shape << " point " << p;
        }
    }
}

TEST_P(RandomPolygons, SectorLookUpFindsWhatASearchOfAllSectorsFinds) {
    SCOPED_TRACE(fmt::format("seed {}", k_seed));
    for (int shape = 0; shape < 20; ++shape) {
        const PolarPolygon polygon = draw();
        for (int k = 0; k < 1000; ++k) {
            const Vec2 p = point(1.3);
            ASSERT_EQ(polygon.sector_of(p), sector_by_search(polygon, p)) << "shape " << shape << " point " << p;
        }
    }
}

TEST_P(RandomPolygons, APointOnARayBelongsToTheSectorThatBeginsThere) {
    SCOPED_TRACE(fmt::format("seed {}", k_seed));
    for (int shape = 0; shape < 20; ++shape) {
        const PolarPolygon polygon = draw();
        for (int q = 0; q < polygon.size(); ++q) {
            for (const double exact : {0.0009765625, 0.5, 1.0, 2.0, 1024.0}) {
                ASSERT_EQ(polygon.sector_of(exact * polygon.vertex(q)), q);
            }
            const int rounded = polygon.sector_of(random_.uniform(0.1, 3.0) * polygon.vertex(q));
            ASSERT_TRUE(rounded == q || rounded == polygon.previous(q)) << rounded << " beside " << q;
        }
    }
}

TEST_P(RandomPolygons, DepthIsPositiveExactlyInside) {
    SCOPED_TRACE(fmt::format("seed {}", k_seed));
    int inside = 0;
    for (int shape = 0; shape < 20; ++shape) {
        const PolarPolygon polygon = draw();
        const std::vector<Vec2> outline = polygon.vertices();
        for (int k = 0; k < 1000; ++k) {
            const Vec2 p = point(1.1);
            const double depth = polygon.depth(p);
            if (std::abs(depth) < 1e-13) continue;  // on the outline to round-off
            ASSERT_EQ(depth > 0.0, winding_number(outline, p) == 1) << "depth " << depth << " at " << p;
            inside += depth > 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(inside, 1000);
}

TEST_P(RandomPolygons, DepthIsTheDistanceFromTheLineOfTheSectorsEdge) {
    for (int shape = 0; shape < 20; ++shape) {
        const PolarPolygon polygon = draw();
        for (int k = 0; k < 100; ++k) {
            const Vec2 p = point(1.1);
            const int q = polygon.sector_of(p);
            const Vec2 a = polygon.vertex(q);
            const Vec2 b = polygon.vertex(polygon.next(q));
            // Twice the area of the triangle (a, b, p) over its base, the terms of the triangle test of Fig. 5.
            EXPECT_NEAR(polygon.depth(p), cross(b - a, p - a) / (b - a).norm(), 1e-12);
            EXPECT_NEAR(polygon.offset(q), cross(a, b) / (b - a).norm(), 1e-12);
            EXPECT_NEAR(polygon.normal(q).dot(b - a), 0.0, 1e-15);
            EXPECT_NEAR(polygon.normal(q).norm(), 1.0, 1e-15);
        }
    }
}

TEST_P(RandomPolygons, TheRadiiBoundTheOutline) {
    for (int shape = 0; shape < 20; ++shape) {
        const PolarPolygon polygon = draw();
        double farthest = 0.0, nearest = 1e9;
        for (int q = 0; q < polygon.size(); ++q) {
            farthest = std::max(farthest, polygon.vertex(q).norm());
            nearest = std::min(nearest, distance(Vec2::Zero(), polygon.vertex(q), polygon.vertex(polygon.next(q))));
        }
        EXPECT_NEAR(polygon.outer_radius(), farthest, 1e-15);
        EXPECT_NEAR(polygon.inner_radius(), nearest, 1e-15);
        for (int k = 0; k < 200; ++k) {
            const auto [s, c] = sine_cosine(random_.uniform(0.0, 2.0 * k_pi));
            EXPECT_GE(polygon.depth(0.999 * polygon.inner_radius() * Vec2(c, s)), 0.0);
            EXPECT_LT(polygon.depth(1.001 * polygon.outer_radius() * Vec2(c, s)), 0.0);
        }
    }
}

TEST_P(RandomPolygons, GrowByAFactorInEveryLength) {
    const PolarPolygon polygon = draw();
    const PolarPolygon larger = polygon.scaled(3.0, "larger");
    EXPECT_EQ(larger.name(), "larger");
    EXPECT_EQ(larger.size(), polygon.size());
    EXPECT_DOUBLE_EQ(larger.area(), 9.0 * polygon.area());
    EXPECT_DOUBLE_EQ(larger.polar_moment(), 81.0 * polygon.polar_moment());
    EXPECT_DOUBLE_EQ(larger.outer_radius(), 3.0 * polygon.outer_radius());
    EXPECT_NEAR(larger.inner_radius(), 3.0 * polygon.inner_radius(), 1e-15);
    for (int k = 0; k < 100; ++k) {
        const Vec2 p = point(1.0);
        EXPECT_NEAR(larger.depth(3.0 * p), 3.0 * polygon.depth(p), 1e-12);
    }
}

TEST_P(RandomPolygons, PolarVerticesLeadBackToTheVerticesAndRise) {
    const PolarPolygon polygon = draw();
    for (int q = 0; q < polygon.size(); ++q) {
        const auto [r, theta] = polygon.polar_vertex(q);
        EXPECT_NEAR(r * std::cos(theta), polygon.vertex(q).x(), 1e-15);
        EXPECT_NEAR(r * std::sin(theta), polygon.vertex(q).y(), 1e-15);
        const double turn = polygon.polar_vertex(polygon.next(q)).theta - theta;
        EXPECT_GT(turn < 0.0 ? turn + 2.0 * k_pi : turn, 0.0);
        EXPECT_LT(turn < 0.0 ? turn + 2.0 * k_pi : turn, k_pi);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Styles, RandomPolygons,
    ::testing::Values(OutlineStyle{3, 0.5, 1.0}, OutlineStyle{4, 1.0, 1.0}, OutlineStyle{12, 0.05, 1.0},
                      OutlineStyle{24, 0.8, 1.0}, OutlineStyle{40, 0.1, 3.0}, OutlineStyle{60, 0.3, 5.0},
                      OutlineStyle{256, 0.5, 1.0}, OutlineStyle{257, 0.5, 2.0}, OutlineStyle{1500, 0.9, 1.0}),
    [](const auto& test) { return fmt::format("Vertices{}Uneven{}", test.param.vertices, test.param.unevenness); });

TEST(PolarPolygon, TheOriginCountsAsOnThePositiveXAxis) {
    const std::vector<Vec2> square = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
    const PolarPolygon polygon("square", square, {4.0, Vec2::Zero(), 8.0 / 3.0});
    EXPECT_EQ(polygon.sector_of({0.0, 0.0}), 1);
    EXPECT_EQ(polygon.sector_of({-0.0, -0.0}), 1);
    EXPECT_EQ(polygon.sector_of({5e-324, 0.0}), 1);
    EXPECT_DOUBLE_EQ(polygon.depth({0.0, 0.0}), 1.0);
}

// A hundred vertices within 1e-13 rad of one another: many to one bin of the table, and rays closer than round-off of
// the pseudo-angle.
TEST(PolarPolygon, FindsSectorsNarrowerThanTheRoundOffOfTheTable) {
    std::vector<Vec2> points;
    for (int k = 0; k < 100; ++k) points.emplace_back(1.0, 0.999 + 1e-15 * k);
    points.emplace_back(-1.0, 0.0);
    points.emplace_back(0.0, -1.0);
    const PolarPolygon polygon("crowded", points, k_any_mass);
    for (int q = 0; q < polygon.size(); ++q) {
        EXPECT_EQ(polygon.sector_of(polygon.vertex(q)), q);
        const Vec2 middle = 0.5 * (polygon.vertex(q) + polygon.vertex(polygon.next(q)));
        const int found = polygon.sector_of(middle);
        EXPECT_TRUE(sector_holds(polygon, found, middle)) << found << " for the middle of edge " << q;
    }
}

// Bins begin at pseudo-angles that are multiples of 1/4, here on the ray through (3, 1). The point lies clockwise of
// it by less than the sum of its coordinates can show.
TEST(PolarPolygon, FindsTheSectorBeforeARayWhereRoundOffPutsThePointBeyondIt) {
    const std::vector<Vec2> points = {{3.0, 1.0}, {0.0, 3.0}, {-3.0, -1.0}, {1.0, -3.0}};
    const PolarPolygon polygon("it", points, k_any_mass);
    const Vec2 p{0.75, std::nextafter(0.25, 0.0)};
    ASSERT_EQ(p.x() + p.y(), 1.0);
    EXPECT_EQ(polygon.sector_of(p), 3);
    EXPECT_EQ(polygon.sector_of({0.75, 0.25}), 0);
}

TEST(PolarPolygon, VerticesOnAStraightSideAreFine) {
    const std::vector<Vec2> bar = {{-2.0, -1.0}, {0.0, -1.0}, {1.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {-2.0, 1.0}};
    const PolarPolygon polygon("bar", bar, {8.0, Vec2::Zero(), 40.0 / 3.0});
    EXPECT_EQ(polygon.size(), 6);
    EXPECT_EQ(polygon.normal(0), polygon.normal(1));
    EXPECT_DOUBLE_EQ(polygon.depth({0.1, -0.25}), 0.75);
}

std::string refusal(const std::vector<Vec2>& points) {
    try {
        const PolarPolygon polygon("it", points, k_any_mass);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(PolarPolygon, RefusesWhatIsNotStarShapedAndNamesTheVertex) {
    EXPECT_THAT(refusal({{1.0, 0.0}, {0.0, 1.0}}), HasSubstr("2 vertices: give at least 3"));
    EXPECT_THAT(refusal({{1.0, 0.0}, {0.0, 1.0}, {0.4, 0.1}, {-1.0, 0.0}, {0.0, -1.0}}),
                HasSubstr("vertex 2 turns back"));
    EXPECT_THAT(refusal({{1.0, 1.0}, {1.0, -1.0}, {-1.0, 0.0}}), HasSubstr("vertex 1 turns back"));
    EXPECT_THAT(refusal({{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}}), HasSubstr("turns back"));
    std::vector<Vec2> pentagram;
    for (int k = 0; k < 5; ++k) {
        const auto [s, c] = sine_cosine(2.0 * k_pi * 2 * k / 5 + 0.1);
        pentagram.emplace_back(c, s);
    }
    EXPECT_THAT(refusal(pentagram), HasSubstr("winds 2 times"));
    EXPECT_THAT(refusal({{1.0, 0.0}, {std::nan(""), 1.0}, {-1.0, -1.0}}), HasSubstr("vertex 1 turns back"));
    EXPECT_THAT(refusal(std::vector<Vec2>(65535, Vec2(1.0, 0.0))), HasSubstr("give 65534 at most"));
}

TEST(PolarPolygon, RefusesAScaleThatIsNoScale) {
    const std::vector<Vec2> points = {{1.0, 0.0}, {-1.0, 1.0}, {-1.0, -1.0}};
    const PolarPolygon polygon("it", points, k_any_mass);
    for (const double factor : {0.0, -1.0, std::nan(""), 1.0 / 0.0}) {
        EXPECT_THROW((void)polygon.scaled(factor, "scaled"), InputError) << factor;
    }
}

}  // namespace
}  // namespace polargrain::testing
