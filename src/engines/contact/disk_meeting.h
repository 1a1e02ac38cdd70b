#pragma once

#include "src/core/vec2.h"

namespace polargrain {

/// Where two disks that fly past one another, or into one another, are nearest within a sub-step.
struct DiskMeeting {
    double time = 0.0;            ///< from the beginning of the sub-step [s]
    Vec2 normal = Vec2::UnitY();  ///< unit, from j to i at that time
    double distance = 0.0;        ///< of the centres along the normal at the beginning [m]
};

/// apart: from the centre of j to that of i [m]; velocity: of i relative to j [m/s], steady, as gravity pulls both
/// alike; touching: the distance at which they meet [m]; from, to: the times looked at, from the beginning of the
/// sub-step [s].
///
/// Disks that meet do so at the smaller root of |apart + velocity t| = touching; the others are nearest at
/// t = -apart.velocity / velocity^2, or at an end of the time. Seen along the normal of that moment, a pair that meets
/// closes its gap then, and one that does not keeps some of it.
DiskMeeting find_meeting(const Vec2& apart, const Vec2& velocity, double touching, double from, double to);

}  // namespace polargrain
