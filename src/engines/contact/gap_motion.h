#pragma once

#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/model/step_report.h"

namespace polargrain {

inline std::size_t at(BodyIndex grain) { return static_cast<std::size_t>(grain); }

/// Velocity of i relative to j at the contact, along the normal [m/s]; > 0 while the gap opens.
inline double normal_speed(const GapContact& c, const std::vector<SolverBody>& bodies) {
    const SolverBody& i = bodies[at(c.i)];
    double u = c.normal.dot(i.velocity) + c.arm_ni * i.spin;
    if (is_wall(c.j)) return u - c.normal.dot(c.wall_velocity);
    const SolverBody& j = bodies[at(c.j)];
    return u - c.normal.dot(j.velocity) - c.arm_nj * j.spin;
}

/// The same along the tangent.
inline double tangent_speed(const GapContact& c, const std::vector<SolverBody>& bodies) {
    const Vec2 t = c.tangent();
    const SolverBody& i = bodies[at(c.i)];
    double u = t.dot(i.velocity) + c.arm_ti * i.spin;
    if (is_wall(c.j)) return u - t.dot(c.wall_velocity);
    const SolverBody& j = bodies[at(c.j)];
    return u - t.dot(j.velocity) - c.arm_tj * j.spin;
}

/// Gives i an impulse [N s/m].
inline void push_i(const GapContact& c, SolverBody& i, double normal, double tangential) {
    const Vec2 p = normal * c.normal + tangential * c.tangent();
    i.velocity += i.inverse_mass * p;
    i.spin += i.inverse_inertia * (normal * c.arm_ni + tangential * c.arm_ti);
}

/// Gives j, a grain, the reaction to an impulse on i [N s/m].
inline void push_j(const GapContact& c, SolverBody& j, double normal, double tangential) {
    const Vec2 p = normal * c.normal + tangential * c.tangent();
    j.velocity -= j.inverse_mass * p;
    j.spin -= j.inverse_inertia * (normal * c.arm_nj + tangential * c.arm_tj);
}

/// Gives i an impulse [N s/m], and j its reaction.
inline void push(const GapContact& c, std::vector<SolverBody>& bodies, double normal, double tangential) {
    push_i(c, bodies[at(c.i)], normal, tangential);
    if (!is_wall(c.j)) push_j(c, bodies[at(c.j)], normal, tangential);
}

/// Books what a wall gets of an impulse on i [N s/m].
inline void take_reaction(const GapContact& c, const Vec2& impulse, StepReport& report) {
    if (!is_wall(c.j)) return;
    WallImpulse& wall = report.walls[static_cast<std::size_t>(wall_index(c.j))];
    wall.linear -= impulse;
    wall.angular -= cross(c.point, impulse);
    report.ledger.wall_work += impulse.dot(c.wall_velocity);
}

}  // namespace polargrain
