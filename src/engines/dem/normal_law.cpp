#include "src/engines/dem/normal_law.h"

#include <algorithm>
#include <cmath>

#include "src/core/elementary.h"

namespace polargrain {

namespace {

/// Root of a rising function between low and high; bisection, as it runs at the birth of a contact only.
template <typename Function>
double rising_root(Function f, double low, double high) {
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

Elastic hertz_spring(double overlap, double k) {
    const double force = k * overlap * std::sqrt(overlap);
    return {force, 0.4 * force * overlap};
}

Elastic power_spring(double overlap, double k, double b) {
    if (!(overlap > 0.0)) return {};
    const double force = k * power(overlap, 1.0 + b);
    return {force, force * overlap / (2.0 + b)};
}

double damping_ratio_with_tension(double e) {
    const double alpha = -natural_log(e) / k_pi;
    return alpha / std::sqrt(1.0 + alpha * alpha);
}

double damping_ratio_without_tension(double e) {
    const double wanted = -natural_log(e);
    if (!(wanted > 0.0)) return 0.0;
    if (wanted <= 2.0) {
        // gamma = sin(psi): -ln e = tan(psi) (pi - 2 psi).
        const double psi = rising_root(
            [wanted](double angle) {
                const auto [sine, cosine] = sine_cosine(angle);
                return sine * (k_pi - 2.0 * angle) - wanted * cosine;
            },
            0.0, 0.5 * k_pi);
        return sine_cosine(psi).sine;
    }
    const auto hyperbolic = [](double chi) {
        const double up = exponential(chi);
        return std::pair{0.5 * (up + 1.0 / up), 0.5 * (up - 1.0 / up)};
    };
    const double chi = rising_root(
        [&](double c) {
            const auto [cosh, sinh] = hyperbolic(c);
            return 2.0 * c * cosh - wanted * sinh;
        },
        0.0, wanted);
    return hyperbolic(chi).first;
}

double proportional_damping(const Elastic& elastic, double gamma, double mass) {
    return elastic.energy > 0.0 ? gamma * elastic.force * std::sqrt(2.0 * mass / elastic.energy) : 0.0;
}

double damping_constant(double gamma, double mass, double k, double b, double g, double reference) {
    return 2.0 * gamma * std::sqrt(mass * k * (1.0 + 0.5 * b)) * power(reference, 0.5 * b - g);
}

FaceForce damped_face(double elastic_force, double damping, double closing, double spin, double width, bool tension) {
    const double mean = elastic_force + damping * closing;
    // By how much the force that the part at an edge stands for differs from the mean.
    const double half = 0.5 * width * std::abs(damping * spin);
    if (tension || half <= mean) return {mean, -damping * spin * width * width / 12.0};
    if (mean <= -half) return {};
    // The rest of the face is let go; the pressure falls to zero along the part that is left.
    const double part = 0.5 * (mean + half) / half;
    const double force = 0.5 * part * (mean + half);
    return {force, -std::copysign(force * width * (0.5 - part / 3.0), spin)};
}

double walton_braun_loss(double largest, double k1, double k2) {
    return 0.5 * k1 * largest * largest * (1.0 - k1 / k2);
}

Hysteretic walton_braun_spring(double overlap, double largest, double k1, double k2) {
    const double reached = std::max(overlap, largest);
    const double rest = reached * (1.0 - k1 / k2);
    const double give = std::max(0.0, overlap - rest);
    return {k2 * give, 0.5 * k2 * give * give, walton_braun_loss(reached, k1, k2), reached};
}

}  // namespace polargrain
