#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "src/detect/outline_kernels.h"
#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// How far the grain reaches from its centre of mass along a unit direction of its own frame [m].
inline double reach_along(const PolarPolygon& grain, const Vec2& direction) {
    return outline_kernels().reach(grain.x(), grain.y(), grain.size(), direction.x(), direction.y());
}

/// Calls visit(k) in rising order for each vertex k of the grain whose station along the unit direction (of its own
/// frame) exceeds `limit` [m]. Stops and returns true at the first visit that returns true.
template <typename Visit>
bool any_vertex_beyond(const PolarPolygon& grain, const Vec2& direction, double limit, Visit visit) {
    for (int base = 0; base < grain.size(); base += 64) {
        // A mask first: few vertices face, and a branch on each would be mispredicted.
        const int count = std::min(grain.size() - base, 64);
        std::uint64_t mask =
            outline_kernels().beyond(grain.x() + base, grain.y() + base, count, direction.x(), direction.y(), limit);
        for (; mask != 0; mask &= mask - 1) {
            if (visit(base + std::countr_zero(mask))) return true;
        }
    }
    return false;
}

/// The same for the vertices that can lie in another body, which stands about the origin of the frame that the grain's
/// pose is given in and reaches `other_reach` [m] towards the grain: those beyond the line across the way at that
/// distance [HN94, Fig. 4].
template <typename Visit>
bool any_facing_vertex(const PolarPolygon& grain, const Pose& pose, double other_reach, Visit visit) {
    const double distance = std::sqrt(pose.centre.squaredNorm());
    const Vec2 towards = distance > 0.0 ? Vec2(pose.turned_back(-pose.centre / distance)) : Vec2(Vec2::Zero());
    return any_vertex_beyond(grain, towards, distance - other_reach, visit);
}

/// The same for another polygon: how far it reaches towards a grain at the given pose in its frame.
inline double reach_towards(const PolarPolygon& other, const Pose& pose) {
    const double distance = std::sqrt(pose.centre.squaredNorm());
    return distance > 0.0 ? reach_along(other, pose.centre / distance) : other.outer_radius();
}

}  // namespace polargrain
