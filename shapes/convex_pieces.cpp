#include "shapes/convex_pieces.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/partition_2.h>

#include <cmath>
#include <iterator>
#include <list>

#include "src/core/error.h"

namespace polargrain {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Partition_traits_2<Kernel>;
using CgalPolygon = Traits::Polygon_2;

/// A side that turns by less than this [rad] at a vertex is straight there.
constexpr double k_straight = 1e-10;

bool straight_at(const Vec2& before, const Vec2& here, const Vec2& after) {
    const Vec2 in = here - before;
    const Vec2 out = after - here;
    return in.dot(out) > 0.0 &&
           std::abs(cross(in, out)) <= k_straight * std::sqrt(in.squaredNorm() * out.squaredNorm());
}

CgalPolygon corners_of(const PolarPolygon& outline) {
    CgalPolygon corners;
    for (int q = 0; q < outline.size(); ++q) {
        const Vec2 v = outline.vertex(q);
        if (straight_at(outline.vertex(outline.previous(q)), v, outline.vertex(outline.next(q)))) continue;
        corners.push_back({v.x(), v.y()});
    }
    return corners;
}

std::list<CgalPolygon> partition(const CgalPolygon& corners) {
    std::list<CgalPolygon> parts;
    if (corners.is_convex()) {
        parts.push_back(corners);
    } else if (corners.size() <= static_cast<std::size_t>(k_optimal_vertices)) {
        CGAL::optimal_convex_partition_2(corners.vertices_begin(), corners.vertices_end(), std::back_inserter(parts),
                                         Traits());
    } else {
        CGAL::approx_convex_partition_2(corners.vertices_begin(), corners.vertices_end(), std::back_inserter(parts),
                                        Traits());
    }
    return parts;
}

/// Halves by a chord from the first corner to the middle one until none has too many corners.
void append_halved(ConvexPiece piece, std::size_t most_corners, std::vector<ConvexPiece>& pieces) {
    if (piece.size() <= most_corners) {
        pieces.push_back(std::move(piece));
        return;
    }
    const auto middle = piece.begin() + static_cast<std::ptrdiff_t>(piece.size() / 2);
    ConvexPiece rest(middle, piece.end());
    rest.push_back(piece.front());
    append_halved(ConvexPiece(piece.begin(), middle + 1), most_corners, pieces);
    append_halved(std::move(rest), most_corners, pieces);
}

}  // namespace

std::vector<ConvexPiece> convex_pieces(const PolarPolygon& outline, int most_corners) {
    PG_ASSERT(most_corners >= 4, "most_corners {}", most_corners);
    std::vector<ConvexPiece> pieces;
    for (const CgalPolygon& part : partition(corners_of(outline))) {
        ConvexPiece piece;
        for (auto v = part.vertices_begin(); v != part.vertices_end(); ++v) piece.emplace_back(v->x(), v->y());
        append_halved(std::move(piece), static_cast<std::size_t>(most_corners), pieces);
    }
    return pieces;
}

}  // namespace polargrain
