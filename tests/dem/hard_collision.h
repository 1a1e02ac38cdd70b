#pragma once

#include "src/model/contact.h"

namespace polargrain {

/// The collision of two round bodies as one event, by three numbers [W93].
struct HardCollisionLaw {
    double restitution = 1.0;             ///< e, in [0, 1]
    double friction = 0.0;                ///< mu >= 0
    double tangential_restitution = 1.0;  ///< beta0, in [-1, 1]: reached where friction does not limit it
};

/// A round body that collides; inertia = ratio x mass x radius^2 with the same ratio for both.
struct RoundBody {
    double mass = 1.0;    ///< [kg/m]; infinite for a wall
    double radius = 1.0;  ///< [m]
    Motion motion;
};

/// Impulse [N s/m] on body i as it collides with body j; the normal is a unit vector out of j into i.
///
/// Normal: the closing speed comes back times e. Tangential: the surface speed comes back times beta0, or as much of
/// that as friction x the normal impulse allows. Zero where the bodies do not approach. `inertia_ratio`: 1/2 for disks.
Vec2 hard_collision_impulse(const HardCollisionLaw& law, const RoundBody& i, const RoundBody& j, const Vec2& normal,
                            double inertia_ratio);

/// The motion of a round body after the impulse acted at its surface, at centre + arm.
Motion after_impulse(const RoundBody& body, const Vec2& impulse, const Vec2& arm, double inertia_ratio);

}  // namespace polargrain
