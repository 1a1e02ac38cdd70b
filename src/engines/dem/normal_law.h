#pragma once

#include <algorithm>

namespace polargrain {

/// What a spring has and does at one overlap.
struct Elastic {
    double force = 0.0;   ///< [N/m] per metre of depth, pushing apart
    double energy = 0.0;  ///< stored [J/m]
};

/// k x overlap [K02, eq. 1]; overlap [m] >= 0, k [N/m^2] per metre of depth.
inline Elastic linear_spring(double overlap, double k) { return {k * overlap, 0.5 * k * overlap * overlap}; }

/// k x overlap^(3/2): Hertz [L94]; k [N/m^(5/2)].
Elastic hertz_spring(double overlap, double k);

/// k x overlap^(1 + b), b > -1 [L94]; k [N/m^(2 + b)].
Elastic power_spring(double overlap, double k, double b);

/// Ratio of critical damping gamma that a linear spring and dashpot needs for the restitution e in (0, 1], where
/// the dashpot may pull: the contact ends at overlap zero. e = exp(-pi gamma / sqrt(1 - gamma^2)) [K02, eq. 14].
double damping_ratio_with_tension(double e);

/// The same where the force is never tensile: the contact ends when the force does.
///
/// e = exp(-(gamma / s)(pi - 2 asin gamma)), s = sqrt(1 - gamma^2), below critical damping, which is reached at e =
/// exp(-2); above, with gamma = cosh(chi), e = exp(-2 chi coth(chi)).
double damping_ratio_without_tension(double e);

/// Dashpot constant [N s/m^2] that damps any spring by the ratio gamma at the present overlap: gamma F sqrt(2 m / W).
///
/// For force = k overlap^(1 + b) with any b it is proportional to overlap^(b / 2), which makes the restitution the same
/// at all speeds and equal to that of the linear law [T92; for other b by the substitution y = overlap^(1 +
/// b/2), which makes the equation of motion linear].
double proportional_damping(const Elastic& elastic, double gamma, double mass);

/// D in dashpot = D overlap^g such that it equals the proportional one at the overlap `reference` [m] under the spring
/// k overlap^(1 + b).
double damping_constant(double gamma, double mass, double k, double b, double g, double reference);

/// Normal force of spring and dashpot [CS79]; closing [m/s] > 0 while the bodies approach, damping [N s/m^2].
/// Without tension never negative.
inline double damped_force(double elastic_force, double damping, double closing, bool tension) {
    const double force = elastic_force + damping * closing;
    return tension ? force : std::max(0.0, force);
}

/// Normal force of a face and its moment about the middle of the face.
struct FaceForce {
    double force = 0.0;   ///< [N/m], pushing apart
    double moment = 0.0;  ///< [N], counter-clockwise, on the body that spins: against its spin
};

/// damped_force spread evenly over a face of the given width [m] that turns at `spin` [rad/s] against the other body
/// besides closing: the dashpot meets each part of the face at the speed of that part, and resists the turning too.
/// Without tension no part of the face is pulled. Derived here; of width 0 the force of damped_force alone.
FaceForce damped_face(double elastic_force, double damping, double closing, double spin, double width, bool tension);

/// What the hysteretic law of Walton and Braun has and does.
struct Hysteretic {
    double force = 0.0;    ///< [N/m] >= 0
    double energy = 0.0;   ///< that unloading gives back [J/m]
    double lost = 0.0;     ///< since the contact began [J/m]
    double largest = 0.0;  ///< overlap so far [m], to be handed in next time
};

/// Loading along k1 x overlap, unloading and loading again along k2 (overlap - d0), d0 = largest (1 - k1/k2), never
/// tensile [WB86]. The restitution is sqrt(k1 / k2) at every speed.
Hysteretic walton_braun_spring(double overlap, double largest, double k1, double k2);

/// What that law has taken of a contact that has been as deep as `largest` [J/m].
double walton_braun_loss(double largest, double k1, double k2);

}  // namespace polargrain
