#pragma once

#include <vector>

#include "src/geometry/polar_polygon.h"

namespace polargrain {

/// Corners [m] in the grain's own frame, counter-clockwise.
using ConvexPiece = std::vector<Vec2>;

/// Cuts an outline into convex pieces that together are the grain: none overlaps another, none is lost.
///
/// Every corner of a piece is a vertex of the outline; vertices in the middle of a straight side are left out. As few
/// pieces as possible up to k_optimal_vertices corners (Greene 1983), at most four times as many beyond (Hertel &
/// Mehlhorn 1983), by CGAL with exact predicates; a piece with more corners than `most_corners` >= 4 is then cut in
/// half. Cost: O(n^4) for few corners, 0.5 ms for 24; O(n) beyond.
std::vector<ConvexPiece> convex_pieces(const PolarPolygon& outline, int most_corners);

/// Up to so many corners of an outline the number of pieces is the least possible.
inline constexpr int k_optimal_vertices = 40;

}  // namespace polargrain
