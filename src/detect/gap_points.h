#pragma once

#include <cstdint>
#include <vector>

#include "src/detect/gap_piece.h"
#include "src/geometry/shape.h"

namespace polargrain {

/// A place where two bodies that do not overlap come near one another, or a vertex of one that is inside the other.
///
/// The bodies are called j and i, and the normal points out of j into i. The gap is the distance of the point of one
/// from the straight edge of the other, along the normal; it is exact for straight edges and changes linearly with the
/// bodies' motion, which is what a solver of speculative contacts needs.
struct GapPoint {
    Vec2 point = Vec2::Zero();    ///< world [m]
    Vec2 normal = Vec2::UnitY();  ///< unit, out of j into i
    double gap = 0.0;             ///< [m]; negative: inside
    double low = 0.0,
           high = 0.0;        ///< travel of i past j along t = (n_y, -n_x) for which the point stays over its edge [m]
    std::int32_t vertex = 0;  ///< of the body that owns the point; -1 for a disk
    std::int32_t edge = 0;    ///< of the other body
    bool on_i = true;         ///< the point belongs to i
};

/// Rules that turn all vertices near an edge into the few points that matter.
struct GapRules {
    double margin = 0.0;   ///< gaps beyond this are left out [m]
    double resting = 0.0;  ///< the gap at which bodies rest: scale of what counts as "at a corner" [m]
    static constexpr double k_behind = 0.05;    ///< slope beyond which a neighbour vertex counts as behind an edge
    static constexpr int k_most_per_group = 4;  ///< points kept per group of similar normals
};

/// What the search for gap points tells of two grains besides.
struct Separation {
    bool apart = false;      ///< a straight line is known to part the two: they do not overlap
    double clearance = 0.0;  ///< no vertex of one is nearer to the outline of the other [m]; not positive: unknown
};

/// The points at which grain i may meet grain j, for poses that may overlap; appended to `points`.
///
/// Polygons, for each vertex p of either near the sector edge of the other:
/// - feature rule: p is left out where a neighbour of p lies behind the line of the edge although nothing overlaps:
/// then
///   the edge ends before it gets there, and the true contact is its corner on the edge of the other, which the other
///   direction finds (a "ghost plane" otherwise slows flow by a tenth). Exactly aligned boxes take the edge round the
///   corner instead.
/// - reflex rule: near a re-entrant vertex the edge across it bounds the free space too.
/// - of points with similar normals only those on the lower hull of gap over tangential station can ever become the
///   least gap; at most k_most_per_group of them are kept.
/// Disks meet polygons at the nearest points of their edges and corners.
Separation find_gap_points(const Shape& i, const Pose& pose_i, const Shape& j, const Pose& pose_j,
                           const GapRules& rules, std::vector<GapPoint>& points);

/// The same for a grain (i) and a wall piece (j). Walls are thin and act on both sides; which side a vertex is on is
/// told by where it was at `pose_before`, a pose that did not overlap.
void find_gap_points(const Shape& i, const Pose& pose_i, const Pose& pose_before, const GapPiece& piece,
                     const GapRules& rules, std::vector<GapPoint>& points);

}  // namespace polargrain
