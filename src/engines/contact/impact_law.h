#pragma once

#include "src/core/vec2.h"
#include "src/model/contact.h"

namespace polargrain {

/// Inverse mass and inertia of a body of an impact; zero for a wall, whose motion is prescribed.
struct ImpactBody {
    double inverse_mass = 0.0;     ///< [m/kg], per metre of depth
    double inverse_inertia = 0.0;  ///< [1/(kg m)], about the centre of mass
};

/// An impact reduced to the contact frame (t, n), n out of j into i, t = (n_y, -n_x). [HN94, eqs. 19-23, Fig. 6]
struct ContactFrame {
    Vec2 normal = Vec2::UnitY();
    Vec2 arm_i = Vec2::Zero();  ///< from the centre of mass of i to the contact point [m]
    Vec2 arm_j = Vec2::Zero();
    /// Inverse effective masses: S = S0 + B1 P_X - B3 P_Y, C = C0 - B4 P_X + B2 P_Y. B4 = B3 of the paper, but where a
    /// body stands on a foot that slips with friction.
    double b1 = 0.0, b2 = 0.0, b3 = 0.0, b4 = 0.0;

    Vec2 tangent() const { return right_normal(normal); }
};

ContactFrame contact_frame(const Vec2& normal, const Vec2& arm_i, const ImpactBody& i, const Vec2& arm_j,
                           const ImpactBody& j);

/// Velocity of i relative to j at the contact point.
struct RelativeVelocity {
    double sliding = 0.0;  ///< S, along t [m/s]
    double closing = 0.0;  ///< C, along n [m/s]; negative while the bodies approach
};

RelativeVelocity relative_velocity(const ContactFrame& frame, const Motion& i, const Motion& j);

/// What an impact does. Impulses act on i along t and n, per metre of depth; j receives the opposite.
struct ImpactResult {
    SlipMode mode = SlipMode::separating;
    double tangential = 0.0;        ///< P_X [N s/m]
    double normal = 0.0;            ///< P_Y >= 0
    double restitution_loss = 0.0;  ///< energy taken by the normal impulse [J/m], >= 0
    double friction_loss = 0.0;     ///< energy taken by the tangential impulse [J/m], >= 0
};

/// Planar impact of two rigid bodies at one point: Coulomb friction and energetic restitution in closed form.
///
/// e: Stronge's energetic coefficient, in [0, 1]: the work that the normal impulse does in restitution is -e^2 times
/// its work in compression. mu >= 0. C0 >= 0 gives no impulse. Sources: [HN94, sec. 3.6.1, eqs. 25-45], [S90];
/// unlike inequality (24) of [HN94] jams are included (friction drives the bodies together faster than the normal
/// impulse parts them; then sliding halts during compression). Guarantees: C >= 0 afterwards, |P_X| <= mu P_Y, and
/// the kinetic energy in the frame of j's contact point never rises.
ImpactResult solve_impact(const ContactFrame& frame, const RelativeVelocity& before, double mu, double e);

/// Velocities after the impulse (P_X, P_Y) on i.
void apply_impulse(const ContactFrame& frame, const ImpactResult& impulse, const ImpactBody& i, Motion& motion_i);
void apply_reaction(const ContactFrame& frame, const ImpactResult& impulse, const ImpactBody& j, Motion& motion_j);

}  // namespace polargrain
