#pragma once

#include <optional>

#include "src/engines/dem/soft_contact.h"
#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// Contact of two polygons through a potential on their sectors [ML04, sec. 2].
///
/// The potential phi of a grain is 1 at its centre of mass, 0 on its outline and linear in each sector, so it needs no
/// mesh. W = p x integral over the overlap of (phi_a + phi_b) with p [N/m]; the force is minus its gradient, the
/// integral of the constant gradients over the common part of each two sectors. One touch for the pair: on the line
/// along which the force acts, nearest to the overlap's centroid. None where nothing overlaps.
std::optional<Touch> potential_touch(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b,
                                     const Pose& pose_b, double p);

}  // namespace polargrain
