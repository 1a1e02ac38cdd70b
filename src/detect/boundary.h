#pragma once

#include "src/core/vec2.h"
#include "src/geometry/polar_polygon.h"

namespace polargrain {

// Questions about a straight line piece and a polar polygon, all in the polygon's own frame. They cost O(sectors the
// piece passes), because a star-shaped outline lets the piece be followed from sector to sector.

/// Does the piece from p to q reach deeper than `tolerance` [m] into the polygon anywhere?
///
/// Inside one sector both the piece and the outline are straight, so the piece is deepest there at its own ends or on
/// the rays through the vertices: only those are looked at, and the answer is exact.
bool piece_enters(const PolarPolygon& polygon, const Vec2& p, const Vec2& q, double tolerance);

/// Edge through which the way from a point inside to a point outside first leaves the polygon.
int exit_edge(const PolarPolygon& polygon, const Vec2& inside, const Vec2& outside);

}  // namespace polargrain
