#pragma once

#include <cmath>

namespace polargrain::testing {

/// One head-on impact of a reduced mass on a force law.
struct Impact {
    double duration = 0.0;     ///< [s]
    double largest = 0.0;      ///< overlap [m]
    double restitution = 0.0;  ///< speed out over speed in
};

/// Largest overlap [m] of an undamped impact at the given closing speed under k x overlap^(1 + b): all of m V^2 / 2 is
/// in the spring.
inline double largest_overlap(double mass, double speed, double k, double b) {
    return std::pow((2.0 + b) * mass * speed * speed / (2.0 * k), 1.0 / (2.0 + b));
}

/// Steps x'' = -force(x, v) / mass (x the overlap, v its rate) by classical Runge-Kutta from x = 0, v = speed until the
/// overlap is gone, or the bodies part without a force.
template <typename Force>
Impact collide(Force force, double mass, double speed, double dt) {
    double x = 0.0;
    double v = speed;
    Impact impact;
    const auto acceleration = [&](double at, double rate) { return -force(std::fmax(at, 0.0), rate) / mass; };
    for (;;) {
        const double a1 = acceleration(x, v);
        const double v2 = v + 0.5 * dt * a1;
        const double a2 = acceleration(x + 0.5 * dt * v, v2);
        const double v3 = v + 0.5 * dt * a2;
        const double a3 = acceleration(x + 0.5 * dt * v2, v3);
        const double v4 = v + dt * a3;
        const double next_x = x + dt * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0;
        const double next_v = v + dt * (a1 + 2.0 * a2 + 2.0 * a3 + acceleration(x + dt * v3, v4)) / 6.0;
        const bool parts_free = next_v < 0.0 && force(std::fmax(next_x, 0.0), next_v) == 0.0;
        if (next_x <= 0.0 || parts_free) {
            const double share = next_x <= 0.0 ? x / (x - next_x) : 1.0;
            impact.duration += share * dt;
            impact.restitution = -(v + share * (next_v - v)) / speed;
            return impact;
        }
        x = next_x;
        v = next_v;
        impact.duration += dt;
        impact.largest = std::fmax(impact.largest, x);
    }
}

}  // namespace polargrain::testing
