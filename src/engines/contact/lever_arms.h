#pragma once

#include "src/engines/contact/gap_motion.h"

namespace polargrain {

/// Gives a contact its lever arms and effective masses. arm_i, arm_j [m]: from the centres of mass to where the
/// surfaces meet; that of a wall does not matter.
inline void set_lever_arms(GapContact& c, const std::vector<SolverBody>& bodies, const Vec2& arm_i, const Vec2& arm_j) {
    const Vec2 t = c.tangent();
    const SolverBody& i = bodies[at(c.i)];
    c.arm_ni = cross(arm_i, c.normal);
    c.arm_ti = cross(arm_i, t);
    double n = i.inverse_mass + i.inverse_inertia * c.arm_ni * c.arm_ni;
    double s = i.inverse_mass + i.inverse_inertia * c.arm_ti * c.arm_ti;
    if (!is_wall(c.j)) {
        const SolverBody& j = bodies[at(c.j)];
        c.arm_nj = cross(arm_j, c.normal);
        c.arm_tj = cross(arm_j, t);
        n += j.inverse_mass + j.inverse_inertia * c.arm_nj * c.arm_nj;
        s += j.inverse_mass + j.inverse_inertia * c.arm_tj * c.arm_tj;
    }
    c.mass_n = 1.0 / n;
    c.mass_t = 1.0 / s;
}

/// The arm back from its components: cross(r, n) is also r.t, and cross(r, t) is -r.n.
inline Vec2 lever_arm(const GapContact& c, BodyIndex grain) {
    const bool of_i = c.i == grain;
    return (of_i ? c.arm_ni : c.arm_nj) * c.tangent() - (of_i ? c.arm_ti : c.arm_tj) * c.normal;
}

}  // namespace polargrain
