#pragma once

#include "src/core/vec2.h"
#include "src/geometry/pose.h"
#include "src/geometry/shape.h"

namespace polargrain {

/// Depth, relative to the smaller outer radius, up to which two shapes are touching and not overlapping.
///
/// Without it, round-off rejects three of four moves of boxes that touch exactly (contact-1994 on a row of boxes).
inline constexpr double k_touch_tolerance = 1e-9;

/// A straight piece of a wall at one instant; the free side is on the left of the way from a to b.
struct WallPiece {
    Vec2 a;
    Vec2 b;
};

/// Do the interiors of two grains meet? Exact up to k_touch_tolerance, for non-convex outlines too.
///
/// Finds vertices of either in the other, edges that cross although no vertex is inside (bars laid crosswise), and
/// one grain wholly inside the other. Symmetric: swapping the two never changes the answer.
/// Cost: O(vertices on the facing side).
bool overlap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

/// Does the wall piece reach into the grain: an end point of it inside, or the piece passing through?
///
/// Walls are thin: a grain wholly behind the piece does not overlap it. Exact up to k_touch_tolerance; a vertex of the
/// grain that has gone through the piece implies that the piece reaches into the grain.
bool overlap(const Shape& grain, const Pose& pose, const WallPiece& piece);

}  // namespace polargrain
