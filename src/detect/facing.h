#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// Calls visit(k) in rising order for each vertex k of the grain that can lie within `circle_radius` [m] of the origin
/// of the frame that the grain's pose is given in: those beyond the tangent line of that circle [HN94, Fig. 4].
/// Stops and returns true at the first visit that returns true.
template <typename Visit>
bool any_facing_vertex(const PolarPolygon& grain, const Pose& pose, double circle_radius, Visit visit) {
    const double distance = std::sqrt(pose.centre.squaredNorm());
    const Vec2 towards = distance > 0.0 ? Vec2(pose.turned_back(-pose.centre / distance)) : Vec2(Vec2::Zero());
    const double limit = distance - circle_radius;
    const double tx = towards.x();
    const double ty = towards.y();
    const double* x = grain.x();
    const double* y = grain.y();
    for (int base = 0; base < grain.size(); base += 64) {
        // A mask first: few vertices face, and a branch on each would be mispredicted.
        std::uint64_t mask = 0;
        const int count = grain.size() - base < 64 ? grain.size() - base : 64;
        for (int n = 0; n < count; ++n) {
            mask |= static_cast<std::uint64_t>(x[base + n] * tx + y[base + n] * ty > limit) << n;
        }
        for (; mask != 0; mask &= mask - 1) {
            if (visit(base + std::countr_zero(mask))) return true;
        }
    }
    return false;
}

}  // namespace polargrain
