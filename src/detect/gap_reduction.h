#pragma once

#include <vector>

#include "src/detect/gap_points.h"

namespace polargrain {

/// Drops the points, from index `first` on, that cannot become the least gap under any rigid motion of the pair.
///
/// Points are grouped by similar normals (cosine above 0.7 with the deepest of the group). For a rigid relative motion
/// the gaps of a group change by a + b s with the tangential station s, so only the lower convex hull of (s, gap) can
/// ever carry the contact; of it at most GapRules::k_most_per_group points are kept: the deepest, its neighbours on the
/// hull, and the farthest. Overlapping points are always kept.
void reduce_gap_points(std::vector<GapPoint>& points, std::size_t first);

}  // namespace polargrain
