#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "shapes/convex_pieces.h"
#include "shapes/library.h"
#include "shapes/outline.h"
#include "shapes/shape_spec.h"
#include "tests/geometry/random_outline.h"

namespace polargrain::testing {
namespace {

constexpr int k_most_corners = 8;

double signed_area(const ConvexPiece& piece) {
    double area2 = 0.0;
    for (std::size_t k = 0; k < piece.size(); ++k) area2 += cross(piece[k], piece[(k + 1) % piece.size()]);
    return 0.5 * area2;
}

bool holds(const ConvexPiece& piece, const Vec2& p) {
    for (std::size_t k = 0; k < piece.size(); ++k) {
        if (cross(piece[(k + 1) % piece.size()] - piece[k], p - piece[k]) < 0.0) return false;
    }
    return true;
}

/// Convex, counter-clockwise, few corners, all of them vertices of the outline; areas that add up, and every random
/// point in exactly as many pieces as its winding number says. Returns the number of pieces.
std::size_t check(const PolarPolygon& outline, RandomStream& random) {
    const std::vector<ConvexPiece> pieces = convex_pieces(outline, k_most_corners);
    const std::vector<Vec2> vertices = outline.vertices();
    double area = 0.0;
    for (const ConvexPiece& piece : pieces) {
        EXPECT_GE(piece.size(), 3U) << outline.name();
        EXPECT_LE(piece.size(), static_cast<std::size_t>(k_most_corners)) << outline.name();
        EXPECT_GT(signed_area(piece), 0.0) << outline.name();
        area += signed_area(piece);
        for (std::size_t k = 0; k < piece.size(); ++k) {
            const Vec2& a = piece[k];
            const Vec2& b = piece[(k + 1) % piece.size()];
            const Vec2& c = piece[(k + 2) % piece.size()];
            EXPECT_GE(cross(b - a, c - b), 0.0) << outline.name() << ": not convex";
            EXPECT_NE(std::find(vertices.begin(), vertices.end(), a), vertices.end()) << outline.name();
        }
    }
    EXPECT_NEAR(area / outline.area(), 1.0, 1e-9) << outline.name();
    for (int k = 0; k < 20; ++k) {
        const double r = outline.outer_radius();
        const Vec2 p(random.uniform(-r, r), random.uniform(-r, r));
        const auto in = std::count_if(pieces.begin(), pieces.end(), [&](const auto& piece) { return holds(piece, p); });
        EXPECT_EQ(in, winding_number(vertices, p)) << outline.name() << " at " << p.transpose();
    }
    return pieces.size();
}

TEST(ConvexPieces, OfEveryShippedOutlineAreTheWholeGrain) {
    RandomStream random(1, RandomPurpose::test);
    for (const OutlineFile& file : shape_library()) check(prepare_outline(file.name, file.points), random);
}

TEST(ConvexPieces, OfAThousandRandomOutlinesAreTheWholeGrain) {
    RandomStream random(2, RandomPurpose::test);
    int checked = 0;
    for (int draw = 0; checked < 1000; ++draw) {
        OutlineStyle style;
        style.vertices = 3 + static_cast<int>(random.uniform(0.0, 27.0));
        style.least_radius = random.uniform(0.1, 0.95);
        if (draw % 50 == 0) style.vertices = k_optimal_vertices + 40;  // the other algorithm
        const auto points = random_star_shaped(random, style);
        const auto outline = try_prepare_outline("draw " + std::to_string(draw), points);
        if (!outline) continue;
        check(*outline, random);
        ++checked;
    }
}

TEST(ConvexPieces, AreAsFewAsKnownShapesNeed) {
    RandomStream random(3, RandomPurpose::test);
    const auto count = [&](const ShapeSpec& spec) {
        return check(std::get<PolarPolygon>(make_shape("it", spec, 1)), random);
    };
    EXPECT_EQ(count(RectangleSpec{7.5e-3, 41.8e-3, 24}), 1U);  // no corner but four, however many vertices
    EXPECT_EQ(count(RegularSpec{1.0, 8}), 1U);
    EXPECT_EQ(count(RegularSpec{1.0, 9}), 2U);
    EXPECT_EQ(count(StarSpec{1.0, 0.4, 5}), 4U);         // five reflex corners, a cut mends two of them
    EXPECT_EQ(count(StickSpec{2.0, 0.5, 16}), 2U + 2U);  // 16 corners, halved twice
}

}  // namespace
}  // namespace polargrain::testing
