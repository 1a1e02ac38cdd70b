#pragma once

#include <algorithm>

namespace polargrain {

/// Tangential force of a contact and what it keeps for the next step. Force and sliding count along the contact's
/// tangent; the force acts on the body whose sliding is given.
struct Tangential {
    double force = 0.0;    ///< [N/m] per metre of depth, within friction x normal force
    double stretch = 0.0;  ///< of the spring [m]
    double energy = 0.0;   ///< in the spring [J/m]
};

/// Spring and dashpot in series with Coulomb's slider [CS79; K02, sec. 2.2].
///
/// stretch [m] already includes the sliding of this step; k [N/m^2], damping [N s/m^2], sliding [m/s], limit [N/m] =
/// friction x normal force. Where it slips, the spring is left as stretched as the limit allows.
inline Tangential spring_slider(double stretch, double k, double damping, double sliding, double limit) {
    // The slider holds the spring within the limit, then what spring and dashpot do together. Moving the spring to
    // where the sum of both is at the limit, as in [K02, eq. 10], would stretch it with energy from nowhere.
    const double most = limit / k;
    const double held = k > 0.0 ? std::clamp(stretch, -most, most) : 0.0;
    return {std::clamp(-k * held - damping * sliding, -limit, limit), held, 0.5 * k * held * held};
}

/// Coulomb's slider made continuous by a dashpot: -min(limit, damping |sliding|), without memory.
Tangential viscous_slider(double damping, double sliding, double limit);

/// Memory of the incremental law of Walton and Braun.
struct IncrementalMemory {
    double force = 0.0;    ///< T: friction's resistance to the sliding, against it [N/m]
    double turning = 0.0;  ///< T*: its value when the sliding last turned
    double normal = 0.0;   ///< N of the last evaluation
};

/// T after a further sliding `way` [m] under the normal force N [N/m], with initial stiffness k0 [N/m^2]
/// [WB86].
///
/// dT = K ds, K = k0 [1 - (T - T*) / (mu N - T*)]^(1/3) where T rises, k0 [1 - (T* - T) / (mu N + T*)]^(1/3) where it
/// falls; T* is zero at first, T at each turn of the sliding, and scales with N. The way is integrated in closed form,
/// so that T does not depend on how it is cut into steps.
IncrementalMemory walton_braun_tangential(const IncrementalMemory& before, double way, double k0, double normal,
                                          double friction);

}  // namespace polargrain
