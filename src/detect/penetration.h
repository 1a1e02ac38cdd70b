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

/// All vertices of `owner` deeper than `tolerance` [m] inside `other`, in rising order. Only vertices of the facing
/// side are looked at [HN94, Fig. 4]. relative: pose of the owner in the frame of the other. `found` is cleared first.
void vertices_inside(const PolarPolygon& owner, const PolarPolygon& other, const Pose& relative, double tolerance,
                     std::vector<InsideVertex>& found);

}  // namespace polargrain
