#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "shapes/shape_spec.h"
#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/core/hash.h"

namespace polargrain {
namespace {

using ::testing::HasSubstr;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinite = std::numeric_limits<double>::infinity();
constexpr std::uint64_t k_seed = 1;

PolarPolygon polygon_of(const ShapeSpec& spec, std::uint64_t seed = k_seed, std::uint64_t draw = 0) {
    return std::get<PolarPolygon>(make_shape("it", spec, seed, draw));
}

std::string bits_of(const PolarPolygon& polygon) {
    StateHash hash;
    for (const Vec2& v : polygon.vertices()) hash.add(std::vector<double>{v.x(), v.y()});
    hash.add(std::vector<double>{polygon.area(), polygon.polar_moment()});
    return hash.hex();
}

/// Largest distance of a vertex, turned or mirrored by the matrix, from the nearest vertex.
double asymmetry(const PolarPolygon& polygon, const Eigen::Matrix2d& map) {
    double worst = 0.0;
    for (const Vec2& v : polygon.vertices()) {
        double nearest = k_infinite;
        for (const Vec2& w : polygon.vertices()) nearest = std::min(nearest, (map * v - w).norm());
        worst = std::max(worst, nearest);
    }
    return worst;
}

Eigen::Matrix2d turn(double angle) {
    Eigen::Matrix2d matrix;
    matrix << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return matrix;
}

const Eigen::Matrix2d k_upside_down = Eigen::Vector2d(1.0, -1.0).asDiagonal();
const Eigen::Matrix2d k_left_right = Eigen::Vector2d(-1.0, 1.0).asDiagonal();

class Rectangles : public ::testing::TestWithParam<int> {};

TEST_P(Rectangles, KeepAreaMomentAndCornersHoweverManyVerticesTheyHave) {
    const double w = 7.5e-3, h = 41.8e-3;
    const PolarPolygon domino = polygon_of(RectangleSpec{w, h, GetParam()});
    EXPECT_EQ(domino.size(), GetParam());
    EXPECT_NEAR(domino.area() / (w * h), 1.0, 1e-15);
    EXPECT_NEAR(domino.polar_moment() / (w * h * (w * w + h * h) / 12.0), 1.0, 1e-14);
    EXPECT_EQ(domino.vertex(0), Vec2(-0.5 * w, -0.5 * h));
    EXPECT_NEAR(domino.inner_radius(), 0.5 * w, 1e-17);
    EXPECT_NEAR(domino.outer_radius(), 0.5 * std::hypot(w, h), 1e-17);
    for (const Vec2& v : domino.vertices()) {
        EXPECT_TRUE(std::abs(v.x()) == 0.5 * w || std::abs(v.y()) == 0.5 * h) << v;
    }
    if (GetParam() % 2 == 0) {
        EXPECT_LT(asymmetry(domino, k_upside_down), 1e-17);
        EXPECT_LT(asymmetry(domino, k_left_right), 1e-17);
    }
}

INSTANTIATE_TEST_SUITE_P(Vertices, Rectangles, ::testing::Values(4, 5, 6, 7, 8, 11, 24, 100));

TEST(Rectangle, SpreadsItsVerticesEvenlyByLength) {
    const PolarPolygon domino = polygon_of(RectangleSpec{7.5, 41.8, 24});
    double shortest = k_infinite, longest = 0.0;
    for (int q = 0; q < domino.size(); ++q) {
        const double edge = (domino.vertex(domino.next(q)) - domino.vertex(q)).norm();
        shortest = std::min(shortest, edge);
        longest = std::max(longest, edge);
    }
    EXPECT_LT(longest, 1.2 * shortest);
}

TEST(DiskSpec, GivesATrueCircle) {
    const Shape disk = make_shape("coin", DiskSpec{0.02}, k_seed);
    ASSERT_TRUE(std::holds_alternative<Disk>(disk));
    EXPECT_EQ(name(disk), "coin");
    EXPECT_DOUBLE_EQ(area(disk), k_pi * 4e-4);
}

class RegularPolygons : public ::testing::TestWithParam<int> {};

TEST_P(RegularPolygons, HaveTheClosedFormsAndTheSymmetry) {
    const int n = GetParam();
    const double r = 0.3;
    const PolarPolygon polygon = polygon_of(RegularSpec{r, n});
    const double expected_area = 0.5 * n * r * r * std::sin(2.0 * k_pi / n);
    EXPECT_EQ(polygon.size(), n);
    EXPECT_NEAR(polygon.area() / expected_area, 1.0, 1e-14);
    EXPECT_NEAR(polygon.polar_moment() / (expected_area * r * r * (2.0 + std::cos(2.0 * k_pi / n)) / 6.0), 1.0, 1e-14);
    EXPECT_NEAR(polygon.outer_radius(), r, 1e-16);
    EXPECT_NEAR(polygon.inner_radius(), r * std::cos(k_pi / n), 2e-16);
    EXPECT_LT(asymmetry(polygon, turn(2.0 * k_pi / n)), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Sides, RegularPolygons, ::testing::Values(3, 4, 5, 6, 17, 100));

class Ellipses : public ::testing::TestWithParam<int> {};

// The image of a regular polygon under the stretch: its moments about the axes grow by a^2 and b^2.
TEST_P(Ellipses, HaveTheClosedFormsOfAStretchedRegularPolygon) {
    const int n = GetParam();
    const double a = 1.5, b = 0.4;
    const PolarPolygon ellipse = polygon_of(EllipseSpec{2.0 * a, 2.0 * b, n});
    const double circle_area = 0.5 * n * std::sin(2.0 * k_pi / n);
    const double circle_moment = circle_area * (2.0 + std::cos(2.0 * k_pi / n)) / 6.0;
    EXPECT_EQ(ellipse.size(), n);
    EXPECT_NEAR(ellipse.area() / (a * b * circle_area), 1.0, 1e-14);
    EXPECT_NEAR(ellipse.polar_moment() / (a * b * 0.5 * (a * a + b * b) * circle_moment), 1.0, 1e-14);
    EXPECT_LT(asymmetry(ellipse, k_upside_down), 1e-16);
}

INSTANTIATE_TEST_SUITE_P(Vertices, Ellipses, ::testing::Values(3, 8, 32, 1000));

TEST(Ellipse, TendsToTheTrueOne) {
    const PolarPolygon ellipse = polygon_of(EllipseSpec{3.0, 0.8, 10'000});
    EXPECT_NEAR(ellipse.area() / (k_pi * 1.5 * 0.4), 1.0, 1e-7);
    EXPECT_NEAR(ellipse.polar_moment() / (k_pi * 1.5 * 0.4 * (2.25 + 0.16) / 4.0), 1.0, 1e-6);
}

class Superellipses : public ::testing::TestWithParam<double> {};

TEST_P(Superellipses, LieOnTheirCurveWithItsAreaInTheLimit) {
    const double n = GetParam(), a = 1.0, b = 0.6;
    const PolarPolygon shape = polygon_of(SuperellipseSpec{2.0 * a, 2.0 * b, n, 4000});
    for (const Vec2& v : shape.vertices()) {
        ASSERT_NEAR(std::pow(std::abs(v.x() / a), n) + std::pow(std::abs(v.y() / b), n), 1.0, 1e-12) << v;
    }
    const double g = std::tgamma(1.0 + 1.0 / n);
    EXPECT_NEAR(shape.area() / (4.0 * a * b * g * g / std::tgamma(1.0 + 2.0 / n)), 1.0,
                n < 1.0 ? 1e-3 : 1e-5);  // cusps need more vertices
    EXPECT_LT(asymmetry(polygon_of(SuperellipseSpec{2.0 * a, 2.0 * b, n, 64}), k_left_right), 1e-15);
    EXPECT_LT(asymmetry(polygon_of(SuperellipseSpec{2.0 * a, 2.0 * b, n, 64}), k_upside_down), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Exponents, Superellipses, ::testing::Values(0.5, 1.0, 1.7, 2.0, 2.5, 4.0, 20.0));

TEST(Stick, TendsToABarWithRoundEnds) {
    const double length = 20.0, width = 3.0, a = length - width, r = 0.5 * width;
    const PolarPolygon stick = polygon_of(StickSpec{length, width, 4000});
    const double bar = a * width * (a * a + width * width) / 12.0;
    const double ends = 0.5 * k_pi * r * r * r * r + k_pi * r * r * 0.25 * a * a + 4.0 / 3.0 * a * r * r * r;
    EXPECT_NEAR(stick.area() / (a * width + k_pi * r * r), 1.0, 1e-6);
    EXPECT_NEAR(stick.polar_moment() / (bar + ends), 1.0, 1e-6);
}

TEST(Stick, HasItsVerticesOnTheTwoEnds) {
    const PolarPolygon stick = polygon_of(StickSpec{20.0, 3.0, 16});
    EXPECT_EQ(stick.size(), 16);
    for (const Vec2& v : stick.vertices()) {
        EXPECT_NEAR((v - Vec2(std::copysign(8.5, v.x()), 0.0)).norm(), 1.5, 1e-14);
        EXPECT_GE(std::abs(v.x()), 8.5 - 1e-14);
    }
    EXPECT_LT(asymmetry(stick, turn(k_pi)), 1e-14);
    EXPECT_LT(asymmetry(stick, k_upside_down), 1e-14);
}

TEST(Star, HasItsAreaItsNotchesAndItsSymmetry) {
    for (const int points : {3, 4, 5, 12}) {
        const PolarPolygon star = polygon_of(StarSpec{1.0, 0.3, points});
        EXPECT_EQ(star.size(), 2 * points);
        EXPECT_NEAR(star.area() / (points * 0.3 * std::sin(k_pi / points)), 1.0, 1e-14);
        EXPECT_NEAR(star.outer_radius(), 1.0, 1e-15);
        EXPECT_LE(star.inner_radius(), 0.3);
        EXPECT_LT(asymmetry(star, turn(2.0 * k_pi / points)), 1e-14);
    }
}

TEST(Polar, PutsVerticesWhereItSays) {
    const PolarPolygon kite = polygon_of(PolarSpec{{{2.0, 0.0}, {1.0, 0.5 * k_pi}, {2.0, k_pi}, {1.0, 1.5 * k_pi}}});
    EXPECT_NEAR((kite.vertex(0) - Vec2(2.0, 0.0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((kite.vertex(3) - Vec2(0.0, -1.0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR(kite.area(), 4.0, 1e-15);
}

TEST(Outline, IsMovedToItsCentroid) {
    const PolarPolygon square = polygon_of(OutlineSpec{{{10.0, 10.0}, {12.0, 10.0}, {12.0, 12.0}, {10.0, 12.0}}});
    EXPECT_EQ(square.vertices(), (std::vector<Vec2>{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}));
}

TEST(Rough, DrawsDependOnSeedAndNumberAlone) {
    const RoughSpec spec{.radius = 1e-3, .roughness = 0.2};
    EXPECT_EQ(bits_of(polygon_of(spec, 1, 7)), bits_of(polygon_of(spec, 1, 7)));
    EXPECT_NE(bits_of(polygon_of(spec, 1, 7)), bits_of(polygon_of(spec, 1, 8)));
    EXPECT_NE(bits_of(polygon_of(spec, 1, 7)), bits_of(polygon_of(spec, 2, 7)));
    EXPECT_TRUE(differs_by_grain(spec));
    RoughSpec same = spec;
    same.same = true;
    EXPECT_EQ(bits_of(polygon_of(same, 1, 7)), bits_of(polygon_of(same, 1, 8)));
    EXPECT_FALSE(differs_by_grain(same));
    EXPECT_FALSE(differs_by_grain(RegularSpec{1.0, 6}));
}

// Draws are part of what makes a run repeatable: these bits may change only together with a note to users.
TEST(Rough, DrawsAreTheSameBitsEverywhere) {
    EXPECT_EQ(bits_of(polygon_of(RoughSpec{.radius = 1e-3, .roughness = 0.2}, 1, 0)), "23812d15fcdf8637");
}

// f has variance 1/2 before it is clipped at +-1; a normal variable so clipped has variance 0.3711.
TEST(Rough, RadiiSpreadAsTheRoughnessSays) {
    constexpr int k_draws = 3000;
    constexpr double k_roughness = 0.01;  // small: then moving the centre of mass counts only at second order
    constexpr double k_clipped_deviation = 0.6092;
    double mean = 0.0, square = 0.0;
    for (int draw = 0; draw < k_draws; ++draw) {
        const PolarPolygon grain =
            polygon_of(RoughSpec{.radius = 1.0, .roughness = k_roughness}, k_seed, static_cast<std::uint64_t>(draw));
        ASSERT_EQ(grain.size(), 24);
        for (int q = 0; q < grain.size(); ++q) {
            const double f = (grain.polar_vertex(q).r - 1.0) / k_roughness;
            mean += f;
            square += f * f;
        }
    }
    mean /= 24.0 * k_draws;
    square /= 24.0 * k_draws;
    EXPECT_NEAR(mean, 0.0, 0.02);
    EXPECT_NEAR(std::sqrt(square) / k_clipped_deviation, 1.0, 0.02);
}

// One mode only: clipping then adds no first mode, and the centre of mass stays.
TEST(Rough, RadiiStayWithinTheRoughness) {
    const RoughSpec spec{.radius = 1.0, .roughness = 0.4, .vertices = 24, .first_mode = 3, .last_mode = 3};
    int clipped = 0;
    for (std::uint64_t draw = 0; draw < 200; ++draw) {
        const PolarPolygon grain = polygon_of(spec, k_seed, draw);
        for (int q = 0; q < grain.size(); ++q) {
            const double f = (grain.polar_vertex(q).r - 1.0) / 0.4;
            ASSERT_LT(std::abs(f), 1.0 + 1e-12);
            clipped += std::abs(f) > 1.0 - 1e-12 ? 1 : 0;
        }
    }
    EXPECT_GT(clipped, 0);
}

TEST(Rough, OfNoRoughnessIsARegularPolygon) {
    EXPECT_EQ(bits_of(polygon_of(RoughSpec{.radius = 1.0, .roughness = 0.0, .vertices = 12}, 5, 3)),
              bits_of(polygon_of(RegularSpec{1.0, 12})));
}

TEST(Rough, HasPowerInItsModesOnly) {
    const RoughSpec spec{.radius = 1.0, .roughness = 0.01, .vertices = 64, .first_mode = 3, .last_mode = 5};
    std::vector<double> power(12, 0.0);
    for (std::uint64_t draw = 0; draw < 50; ++draw) {
        const PolarPolygon grain = polygon_of(spec, k_seed, draw);
        for (int mode = 1; mode < 12; ++mode) {
            Vec2 amplitude = Vec2::Zero();
            for (int q = 0; q < 64; ++q) {
                const auto [s, c] = sine_cosine(2.0 * k_pi * mode * q / 64);
                amplitude += grain.polar_vertex(q).r / 64.0 * Vec2(c, s);
            }
            power[static_cast<std::size_t>(mode)] += amplitude.squaredNorm();
        }
    }
    const double total = std::accumulate(power.begin(), power.end(), 0.0);
    EXPECT_GT((power[3] + power[4] + power[5]) / total, 0.97);  // clipping puts the rest into other modes
    for (const std::size_t mode : {3U, 4U, 5U}) EXPECT_GT(power[mode] / total, 0.2) << mode;
}

TEST(Rough, EveryDrawIsAGrainEvenWhereDrawsAreSpiky) {
    for (std::uint64_t draw = 0; draw < 500; ++draw) {
        const PolarPolygon grain = polygon_of(RoughSpec{.radius = 1.0, .roughness = 0.95, .vertices = 48}, 3, draw);
        EXPECT_GT(grain.inner_radius(), 0.0);
    }
}

TEST(Rough, LeavesOutModesThatItsVerticesCannotShow) {
    const RoughSpec few{.radius = 1.0, .roughness = 0.3, .vertices = 8, .first_mode = 2, .last_mode = 6};
    const RoughSpec as_shown{.radius = 1.0, .roughness = 0.3, .vertices = 8, .first_mode = 2, .last_mode = 4};
    EXPECT_EQ(bits_of(polygon_of(few)), bits_of(polygon_of(as_shown)));
}

struct Refusal {
    ShapeSpec spec;
    const char* says;
};

class RefusedSpecs : public ::testing::TestWithParam<Refusal> {};

TEST_P(RefusedSpecs, SayWhichValueIsWrong) {
    try {
        (void)make_shape("pebble", GetParam().spec, k_seed);
        FAIL() << "accepted; it should say: " << GetParam().says;
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("shape \"pebble\""));
        EXPECT_THAT(error.what(), HasSubstr(GetParam().says));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Values, RefusedSpecs,
    ::testing::Values(
        Refusal{RectangleSpec{0.0, 1.0, 4}, "width is 0: give a finite length above 0 [m]"},
        Refusal{RectangleSpec{1.0, k_nan, 4}, "height is nan"},
        Refusal{RectangleSpec{1.0, 1.0, 3}, "vertices is 3: give a whole number from 4 to 65534"},
        Refusal{RectangleSpec{1.0, 1.0, 70000}, "vertices is 70000"}, Refusal{DiskSpec{-2.0}, "radius is -2"},
        Refusal{DiskSpec{k_infinite}, "radius is inf"}, Refusal{RegularSpec{1.0, 2}, "sides is 2"},
        Refusal{RegularSpec{-1.0, 6}, "radius is -1"}, Refusal{EllipseSpec{1.0, -1.0, 8}, "height is -1"},
        Refusal{EllipseSpec{1.0, 1.0, 2}, "vertices is 2"},
        Refusal{SuperellipseSpec{1.0, 1.0, 0.0, 8}, "exponent is 0: give a number from 0.2 to 100"},
        Refusal{SuperellipseSpec{1.0, 1.0, k_nan, 8}, "exponent is nan"},
        Refusal{StickSpec{1.0, 1.0, 16}, "length 1 is not above width 1"},
        Refusal{StickSpec{2.0, 1.0, 7}, "vertices is 7: give an even number"},
        Refusal{StickSpec{2.0, 1.0, 4}, "vertices is 4"}, Refusal{StarSpec{1.0, 1.0, 5}, "inner_radius 1 is not below"},
        Refusal{StarSpec{1.0, 0.0, 5}, "inner_radius is 0"}, Refusal{StarSpec{1.0, 0.5, 2}, "points is 2"},
        Refusal{RoughSpec{.radius = 0.0, .roughness = 0.1}, "radius is 0"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = 1.0}, "roughness is 1: give a number in [0, 1)"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = -0.1}, "roughness is -0.1"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = k_nan}, "roughness is nan"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = 0.1, .vertices = 2}, "vertices is 2"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = 0.1, .first_mode = 0}, "modes run from 0 to 6"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = 0.1, .first_mode = 7}, "modes run from 7 to 6"},
        Refusal{RoughSpec{.radius = 1.0, .roughness = 0.1, .vertices = 12, .first_mode = 8, .last_mode = 9},
                "12 vertices cannot show mode 8"},
        Refusal{PolarSpec{{{1.0, 0.0}, {1.0, 2.0}}}, "2 vertices: give at least 3"},
        Refusal{PolarSpec{{{1.0, 0.0}, {1.0, 2.0}, {0.0, 4.0}}}, "the radius of vertex 2 is 0"},
        Refusal{PolarSpec{{{1.0, 0.0}, {1.0, k_nan}, {1.0, 4.0}}}, "the angle of vertex 1 is nan"},
        Refusal{PolarSpec{{{1.0, 0.0}, {1.0, 2.0}, {1.0, 1.0}}}, "angles must rise"},
        Refusal{PolarSpec{{{1.0, 0.0}, {1.0, 2.0}, {1.0, 6.4}}}, "stay within one turn"},
        Refusal{OutlineSpec{{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}}, "edge 0-1 meets edge 2-3"},
        Refusal{OutlineSpec{{{0.0, 0.0}, {1.0, 1.0}}}, "give at least 3"}));

}  // namespace
}  // namespace polargrain
