#pragma once

#include <optional>

#include "src/detect/contact_normal.h"
#include "src/detect/overlap.h"
#include "src/model/contact.h"

namespace polargrain {

/// A shape where it is and how it moves; what contact detection asks of a body.
struct PlacedShape {
    const Shape& shape;
    const Pose& pose;
    Motion motion;

    Vec2 velocity_at(const Vec2& world) const { return motion.velocity + cross(motion.spin, world - pose.centre); }
};

/// One point at which two overlapping bodies exchange an impulse.
struct ContactGeometry {
    Vec2 point = Vec2::Zero();    ///< world frame [m]
    Vec2 normal = Vec2::UnitY();  ///< unit, out of b into a
    double depth = 0.0;           ///< of the contact vertex, or of the overlap, [m] >= 0
    NormalCase which = NormalCase::edge;
};

/// The contact of two overlapping grains, a and b. [HN94, secs. 3.4.1 and 3.5]
///
/// Contact vertex: of all vertices of either grain inside the other, the deepest that approaches along the penetrated
/// edge's normal; if none approaches, the deepest. Normal: contact_normal(); where that normal makes the contact
/// non-closing and the penetrated edge's makes it closing, the edge's (the paper is silent; without it a quarter of
/// the blocking contacts never exchanges an impulse). Grains that cross without a vertex inside meet at the middle of
/// their widest pair of crossing points, with the normal across it.
/// Disks: the deepest approaching of the faces that the centre is in front of and the corners that stick out towards
/// it, R - distance deep; a disk whose centre is inside a polygon goes out the nearest way and is R + distance deep.
/// None where nothing overlaps beyond k_touch_tolerance.
std::optional<ContactGeometry> find_contact(const PlacedShape& a, const PlacedShape& b);

/// The contact of a grain with a wall piece that it overlaps; normal out of the wall into the grain (a = grain).
///
/// wall_motion: velocity of the wall's material at the world origin and its spin. home: a point of the grain's side of
/// the piece, such as its centre of mass before the move; walls are thin and act on both sides.
/// Contact vertex: the deepest approaching vertex of the grain behind the piece within its span, with the piece's
/// normal; else an end point of the piece inside the grain, with the grain's edge normal.
std::optional<ContactGeometry> find_contact(const PlacedShape& grain, const WallPiece& piece, const Motion& wall_motion,
                                            const Vec2& home);

}  // namespace polargrain
