#pragma once

#include <span>

#include "src/detect/penetration.h"
#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// Which rule of [HN94, Fig. 7] gave a normal.
enum class NormalCase {
    flat,         ///< (a) the owner's outline enters and leaves the other through one edge: that edge's normal
    corner,       ///< (b) one vertex over a corner: through two edges, across the chord of their outer ends
    multi_owner,  ///< (c) as (b), with several vertices of the owner inside
    multi_other,  ///< (d) several vertices of the other inside the owner: across their widest chord
    edge,         ///< degenerate: no crossing, or a chord of no length; the penetrated edge's normal
};

const char* to_string(NormalCase which);

struct ContactNormal {
    Vec2 direction = Vec2::UnitY();  ///< unit, world frame, out of the other into the owner
    NormalCase which = NormalCase::edge;
};

/// Direction in which a grain pushes on another whose vertex lies inside it. [HN94, sec. 3.5, Fig. 7]
///
/// `contact` is the contact vertex, one of `owner_inside` (vertices of the owner inside the other); `other_inside` are
/// the vertices of the other inside the owner. The tolerance [m] is the one these were found with.
/// Limits: both outlines star-shaped about their centre of mass. Cost: O(vertices of the owner that are inside).
ContactNormal contact_normal(const PolarPolygon& owner, const Pose& owner_pose, const PolarPolygon& other,
                             const Pose& other_pose, const InsideVertex& contact,
                             std::span<const InsideVertex> owner_inside, std::span<const InsideVertex> other_inside,
                             double tolerance);

/// Normal of the edge that the vertex has penetrated; world frame, out of the other.
Vec2 penetrated_edge_normal(const PolarPolygon& other, const Pose& other_pose, const InsideVertex& contact);

}  // namespace polargrain
