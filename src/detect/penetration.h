#pragma once

#include <vector>

#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// A vertex of one grain inside another.
struct InsideVertex {
    int vertex;    ///< of the grain that owns it
    int sector;    ///< of the other grain
    double depth;  ///< behind the edge of that sector [m], > tolerance
};

/// All vertices of either grain deeper than `tolerance` [m] inside the other, each in rising order. Only vertices of
/// the facing sides are looked at [HN94, Fig. 4]. The results are cleared first.
void vertices_inside(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b, const Pose& pose_b,
                     double tolerance, std::vector<InsideVertex>& of_a_in_b, std::vector<InsideVertex>& of_b_in_a);

}  // namespace polargrain
