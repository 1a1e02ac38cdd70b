#include "src/engines/contact/face_blow.h"

#include <cmath>
#include <utility>

#include "src/engines/contact/gap_motion.h"

namespace polargrain {

namespace {

/// The place of the pressure and the impulse follow from one another: by a twentieth where the ends close alike to
/// that.
constexpr int k_rounds = 30;
constexpr double k_settled = 1e-15;  ///< of the way between the ends

/// How a unit impulse along one direction moves the two bodies, each as a whole and in its spin.
struct Lever {
    Vec2 direction;
    double arm_i, arm_j;  ///< cross(r, direction) [m]
};

Lever between(const Vec2& d1, double i1, double j1, const Vec2& d2, double i2, double j2, double share) {
    return {(1.0 - share) * d1 + share * d2, (1.0 - share) * i1 + share * i2, (1.0 - share) * j1 + share * j2};
}

/// An impact that two contacts share: its frame, and what it leads to.
class SharedImpact {
public:
    SharedImpact(const GapContact& c, const GapContact& d, const std::vector<SolverBody>& bodies, double share)
        : i_(bodies[at(c.i)]),
          j_(is_wall(c.j) ? SolverBody{} : bodies[at(c.j)]),
          normal_(between(c.normal, c.arm_ni, c.arm_nj, d.normal, d.arm_ni, d.arm_nj, share)),
          tangent_(between(c.tangent(), c.arm_ti, c.arm_tj, d.tangent(), d.arm_ti, d.arm_tj, share)) {
        before_.closing = (1.0 - share) * normal_speed(c, bodies) + share * normal_speed(d, bodies);
        before_.sliding = (1.0 - share) * tangent_speed(c, bodies) + share * tangent_speed(d, bodies);
        friction_ = (1.0 - share) * c.friction + share * d.friction;
    }

    /// With both bodies' relative spin held by the face, or free to change.
    ImpactResult solve(double restitution, bool held) const {
        ContactFrame frame;
        frame.normal = normal_.direction;
        frame.b1 = inverse_mass(tangent_, tangent_, held);
        frame.b2 = inverse_mass(normal_, normal_, held);
        frame.b3 = -inverse_mass(normal_, tangent_, held);
        frame.b4 = frame.b3;
        return solve_impact(frame, before_, friction_, restitution);
    }

    /// By how much impulses change the spin of i against j [rad/s].
    double turn(const ImpactResult& p) const { return p.normal * turn(normal_) + p.tangential * turn(tangent_); }

private:
    double turn(const Lever& p) const { return i_.inverse_inertia * p.arm_i + j_.inverse_inertia * p.arm_j; }

    /// Speed along p for a unit impulse along q. A face that holds the relative spin adds the couple that it takes.
    double inverse_mass(const Lever& p, const Lever& q, bool held) const {
        const double free = (i_.inverse_mass + j_.inverse_mass) * p.direction.dot(q.direction) +
                            i_.inverse_inertia * p.arm_i * q.arm_i + j_.inverse_inertia * p.arm_j * q.arm_j;
        return held ? free - turn(p) * turn(q) / (i_.inverse_inertia + j_.inverse_inertia) : free;
    }

    SolverBody i_, j_;
    Lever normal_, tangent_;
    RelativeVelocity before_;
    double friction_;
};

}  // namespace

FaceBlow solve_face_blow(const GapContact& first, const GapContact& second, const std::vector<SolverBody>& bodies,
                         double restitution) {
    const SharedImpact at_first(first, second, bodies, 0.0);
    const SharedImpact at_second(first, second, bodies, 1.0);
    double share = 0.5;
    for (int n = 0; n < k_rounds; ++n) {
        const ImpactResult held = SharedImpact(first, second, bodies, share).solve(restitution, true);
        // Where between the ends does this impulse turn the bodies by nothing?
        const double turn = at_first.turn(held);
        const double last = std::exchange(share, turn / (turn - at_second.turn(held)));
        if (!(share > 0.0 && share < 1.0)) break;
        if (std::abs(share - last) <= k_settled) return {held, share};
    }
    const bool first_is_nearer = !(share > 0.5);
    const SharedImpact& end = first_is_nearer ? at_first : at_second;
    return {end.solve(restitution, false), first_is_nearer ? 0.0 : 1.0};
}

}  // namespace polargrain
