#include "src/engines/contact/impact_law.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

/// Sliding speed below which an impact counts as direct (S0 = 0), relative to |S0| + |C0|.
constexpr double k_direct = 1e-14;

struct Impulse {
    double tangential;
    double normal;
    double compression_work;  ///< of the normal impulse, <= 0
};

/// No sliding at first: the ratio of impulses q is constant throughout.
Impulse direct(const ContactFrame& f, double c0, double e, double q) {
    const double k = f.b2 - f.b4 * q;
    const double normal = -(1.0 + e) * c0 / k;
    return {q * normal, normal, -0.5 * c0 * c0 / k};
}

/// Slides one way from beginning to end. [HN94, eqs. 32-33]
Impulse sliding(double c0, double e, double s, double mu, double k1) {
    const double normal = -(1.0 + e) * c0 / k1;
    return {-s * mu * normal, normal, -0.5 * c0 * c0 / k1};
}

/// Sliding halts at the impulse `halt` while the bodies still approach; then the ratio of impulse increments is q2.
Impulse halted_in_compression(const ContactFrame& f, double c0, double e, double s, double mu, double k1, double q2,
                              double halt) {
    const double k2 = f.b2 - f.b4 * q2;
    const double c_halt = std::min(0.0, c0 + k1 * halt);
    const double work = 0.5 * ((c0 + c_halt) * halt - c_halt * c_halt / k2);
    const double greatest = halt - c_halt / k2;  // impulse at which the bodies stop approaching
    const double normal = greatest + e * std::sqrt(std::max(0.0, -2.0 * work / k2));
    return {-s * mu * halt + q2 * (normal - halt), normal, work};
}

/// Sliding halts at the impulse `halt` while the bodies already part.
Impulse halted_in_restitution(const ContactFrame& f, double c0, double e, double s, double mu, double k1, double q2,
                              double halt) {
    const double k2 = f.b2 - f.b4 * q2;
    const double c_halt = std::max(0.0, c0 + k1 * halt);
    const double left = std::max(0.0, (e * e * c0 * c0 - c_halt * c_halt) / k1);
    // The quotient form of the root keeps its digits where `left` is small.
    const double root = c_halt + std::sqrt(c_halt * c_halt + k2 * left);
    const double normal = halt + (root > 0.0 ? left / root : 0.0);
    return {-s * mu * halt + q2 * (normal - halt), normal, -0.5 * c0 * c0 / k1};
}

struct Solution {
    SlipMode mode;
    Impulse impulse;
};

Solution solve(const ContactFrame& f, double s0, double c0, double mu, double e) {
    const double stick_ratio = f.b3 / f.b1;
    const bool holds = mu >= std::abs(stick_ratio);  // friction can keep a halted contact from sliding again
    if (std::abs(s0) <= k_direct * (std::abs(s0) + std::abs(c0))) {
        if (holds) return {SlipMode::direct_sticking, direct(f, c0, e, stick_ratio)};
        return {SlipMode::direct_sliding, direct(f, c0, e, std::copysign(mu, f.b3))};
    }
    const double s = s0 > 0.0 ? 1.0 : -1.0;
    const double k1 = f.b2 + s * mu * f.b4;  // dC/dP_Y while sliding
    const double g = mu * f.b1 + s * f.b3;   // -s dS/dP_Y while sliding
    // Cross-multiplied, so that neither a division nor the sign of k1 (a jam) can mislead the classification.
    const double sliding_side = k1 * std::abs(s0);
    const double closing_side = g * (-c0);
    if (g <= 0.0 || sliding_side > closing_side * (1.0 + e)) {
        return {SlipMode::sliding, sliding(c0, e, s, mu, k1)};
    }
    const double halt = std::abs(s0) / g;
    const double q2 = holds ? stick_ratio : s * mu;
    if (sliding_side <= closing_side) {
        return {holds ? SlipMode::sticks_in_compression : SlipMode::reverses_in_compression,
                halted_in_compression(f, c0, e, s, mu, k1, q2, halt)};
    }
    return {holds ? SlipMode::sticks_in_restitution : SlipMode::reverses_in_restitution,
            halted_in_restitution(f, c0, e, s, mu, k1, q2, halt)};
}

}  // namespace

ContactFrame contact_frame(const Vec2& normal, const Vec2& arm_i, const ImpactBody& i, const Vec2& arm_j,
                           const ImpactBody& j) {
    ContactFrame f{normal, arm_i, arm_j};
    const Vec2 t = f.tangent();
    const double xi = arm_i.dot(t);
    const double yi = arm_i.dot(normal);
    const double xj = arm_j.dot(t);
    const double yj = arm_j.dot(normal);
    const double masses = i.inverse_mass + j.inverse_mass;
    f.b1 = masses + yi * yi * i.inverse_inertia + yj * yj * j.inverse_inertia;
    f.b2 = masses + xi * xi * i.inverse_inertia + xj * xj * j.inverse_inertia;
    f.b3 = xi * yi * i.inverse_inertia + xj * yj * j.inverse_inertia;
    f.b4 = f.b3;
    return f;
}

RelativeVelocity relative_velocity(const ContactFrame& frame, const Motion& i, const Motion& j) {
    const Vec2 u = (i.velocity + cross(i.spin, frame.arm_i)) - (j.velocity + cross(j.spin, frame.arm_j));
    return {u.dot(frame.tangent()), u.dot(frame.normal)};
}

ImpactResult solve_impact(const ContactFrame& frame, const RelativeVelocity& before, double mu, double e) {
    const double s0 = before.sliding;
    const double c0 = before.closing;
    if (c0 >= 0.0) return {};
    const auto [mode, p] = solve(frame, s0, c0, mu, e);
    const double s1 = s0 + frame.b1 * p.tangential - frame.b3 * p.normal;
    const double c1 = c0 - frame.b4 * p.tangential + frame.b2 * p.normal;
    const double total_loss = -0.5 * (p.tangential * (s0 + s1) + p.normal * (c0 + c1));
    const double restitution_loss = -(1.0 - e * e) * p.compression_work;
    return {mode, p.tangential, p.normal, restitution_loss, total_loss - restitution_loss};
}

void apply_impulse(const ContactFrame& frame, const ImpactResult& impulse, const ImpactBody& i, Motion& motion_i) {
    const Vec2 p = impulse.tangential * frame.tangent() + impulse.normal * frame.normal;
    motion_i.velocity += i.inverse_mass * p;
    motion_i.spin += i.inverse_inertia * cross(frame.arm_i, p);
}

void apply_reaction(const ContactFrame& frame, const ImpactResult& impulse, const ImpactBody& j, Motion& motion_j) {
    const Vec2 p = impulse.tangential * frame.tangent() + impulse.normal * frame.normal;
    motion_j.velocity -= j.inverse_mass * p;
    motion_j.spin -= j.inverse_inertia * cross(frame.arm_j, p);
}

}  // namespace polargrain
