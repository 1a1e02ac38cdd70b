#pragma once

#include <vector>

#include "src/detect/gap_points.h"

namespace polargrain {

/// Drops the points, from index `first` on, that are not likely to become the least gap before points are found anew.
///
/// Points are grouped by similar normals (cosine above 0.7 with the deepest of the group). For a rigid relative motion
/// the gaps of a group change by a + b s with the tangential station s, so only the lower convex hull of (s, gap) can
/// ever carry the contact. What is off the hull is dropped without loss; of hulls of more than
/// GapRules::k_most_per_group points, only the deepest, its neighbours on the hull, and the farthest are kept, which a
/// large turn may get past. Overlapping points are always kept. Among equal gaps the order of the points decides.
void reduce_gap_points(std::vector<GapPoint>& points, std::size_t first);

}  // namespace polargrain
