#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/engines/dem/integrators.h"
#include "src/engines/dem/normal_law.h"

namespace polargrain {
namespace {

/// x'' = -w^2 x - 2 gamma w x', from x = 0 at speed 1: a linear contact that may pull.
struct Contact {
    double w = 2.0;
    double gamma = 0.0;

    double duration() const { return std::numbers::pi / (w * std::sqrt(1.0 - gamma * gamma)); }
    double exact(double t) const {
        const double s = w * std::sqrt(1.0 - gamma * gamma);
        return std::exp(-gamma * w * t) * std::sin(s * t) / s;
    }
    double exact_rate(double t) const {
        const double s = w * std::sqrt(1.0 - gamma * gamma);
        return std::exp(-gamma * w * t) * std::cos(s * t) - gamma * w * exact(t);
    }
    double largest() const {
        const double s = std::sqrt(1.0 - gamma * gamma);
        return std::exp(-gamma / s * std::acos(gamma)) / w;
    }
    double acceleration(double x, double v) const { return -w * w * x - 2.0 * gamma * w * v; }

    void accelerations(double, const std::vector<double>& x, const std::vector<double>& v,
                       std::vector<double>& a) const {
        a.assign(1, acceleration(x[0], v[0]));
    }
    void accept(double, const std::vector<double>&) const {}
    void solve_implicit(double factor, const std::vector<double>& residual, std::vector<double>& dx) const {
        dx.assign(1, residual[0] / (1.0 + factor * w * w));
    }
};

struct Path {
    double end = 0.0;
    double highest = 0.0;
};

/// From exact values: schemes that look back begin with the first step done, all others at the beginning.
Path follow(SoftIntegrator kind, Contact contact, double until, int steps) {
    const double h = until / steps;
    Integrator integrator = make_integrator(kind);
    SchemeState state{0.0, {0.0}, {1.0}, {contact.acceleration(0.0, 1.0)}};
    if (auto* gear = std::get_if<Gear4>(&integrator)) {
        gear->memory = {-contact.w * contact.w - 2.0 * contact.gamma * contact.w * state.a[0]};
    }
    const auto begin_later = [&] {
        const double x = contact.exact(h);
        state = {h, {x}, {contact.exact_rate(h)}, {contact.acceleration(x, x / h)}};
    };
    if (auto* verlet = std::get_if<PositionVerlet>(&integrator)) {
        begin_later();
        verlet->memory = {h, 0.0};
    }
    if (auto* numerov = std::get_if<Numerov>(&integrator)) {
        begin_later();
        numerov->memory = {h, 0.0, 0.0, -contact.w * contact.w * state.x[0]};
    }
    Path path{0.0, state.x[0]};
    while (state.time < until - 0.5 * h) {
        std::visit([&](auto& scheme) { scheme.step(contact, state, h); }, integrator);
        path.highest = std::max(path.highest, state.x[0]);
    }
    path.end = state.x[0];
    return path;
}

struct Row {
    SoftIntegrator kind;
    const char* name;
    double order, order_damped;          ///< of the position in the middle of the contact, e = 1 and e = 0.5
    double overshoot, overshoot_damped;  ///< largest overlap at four steps per contact over the true one
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class Scheme : public ::testing::TestWithParam<Row> {};

TEST_P(Scheme, HasTheOrderAndTheCoarseBehaviourOfTheTable) {
    const Row& row = GetParam();
    for (const bool damped : {false, true}) {
        Contact contact;
        contact.gamma = damped ? damping_ratio_with_tension(0.5) : 0.0;
        const double until = contact.duration();
        const auto error = [&](int steps) {
            return std::abs(follow(row.kind, contact, until, steps).end - contact.exact(until));
        };
        const double order = std::log2(error(80) / error(160));
        const double overshoot = follow(row.kind, contact, contact.duration(), 4).highest / contact.largest();
        fmt::print("{:22} e {}: order {:.2f} ({}), four steps per contact {:.3f} ({})\n", row.name, damped ? 0.5 : 1.0,
                   order, damped ? row.order_damped : row.order, overshoot,
                   damped ? row.overshoot_damped : row.overshoot);
        EXPECT_NEAR(order, damped ? row.order_damped : row.order, 0.06);
        EXPECT_NEAR(overshoot, damped ? row.overshoot_damped : row.overshoot, 2e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Table, Scheme,
    ::testing::Values(Row{SoftIntegrator::symplectic_euler, "symplectic Euler", 2.00, 1.00, 1.086, 0.713},
                      Row{SoftIntegrator::taylor, "Taylor", 2.01, 1.00, 1.329, 1.192},
                      Row{SoftIntegrator::position_verlet, "position Verlet", 2.00, 1.01, 0.978, 0.826},
                      Row{SoftIntegrator::velocity_verlet_half, "velocity Verlet f=1/2", 2.00, 1.01, 1.086, 0.902},
                      Row{SoftIntegrator::velocity_verlet, "velocity Verlet f=1", 2.00, 1.96, 1.086, 0.967},
                      Row{SoftIntegrator::gear4, "Gear", 4.00, 3.03, 1.005, 1.019},
                      Row{SoftIntegrator::numerov_central, "Numerov central", 3.99, 2.00, 0.999, 0.977},
                      Row{SoftIntegrator::numerov_forward, "Numerov forward", 3.99, 1.00, 0.999, 1.059},
                      Row{SoftIntegrator::numerov_backward, "Numerov backward", 3.99, 1.00, 0.999, 0.868}));

/// Largest amplitude of an undamped oscillation in so many steps of w h.
double amplitude(SoftIntegrator kind, double wh, int steps) {
    Contact contact;
    const double h = wh / contact.w;
    Integrator integrator = make_integrator(kind);
    SchemeState state{0.0, {0.0}, {1.0}, {0.0}};
    double largest = 0.0;
    for (int k = 0; k < steps; ++k) {
        std::visit([&](auto& scheme) { scheme.step(contact, state, h); }, integrator);
        largest = std::fmax(largest, std::abs(state.x[0]));
    }
    return largest * contact.w;
}

TEST(Stability, VerletEndsAtTwoAndNumerovAtRootSix) {
    const double limit = std::sqrt(6.0);
    EXPECT_LT(amplitude(SoftIntegrator::velocity_verlet, 1.98, 1000), 10.0);
    EXPECT_GT(amplitude(SoftIntegrator::velocity_verlet, 2.02, 1000), 1e10);
    EXPECT_LT(amplitude(SoftIntegrator::numerov_central, 0.99 * limit, 1000), 20.0);
    EXPECT_GT(amplitude(SoftIntegrator::numerov_central, 1.01 * limit, 1000), 1e10);
}

TEST(Sandwich, BlowsUpWithVerletAtThreeAndAHalfMillisecondsAndNotWithNumerov) {
    // A bead between two walls [S13]: D = 8 mm, rho 2520, k = 250 N/m on each side, m = 6.756e-4 kg, w = 608.32 / s
    // because the walls' springs are two pairs; x = 0.15 R cos(w t).
    Contact bead;
    bead.w = 608.32;
    const double amplitude_exact = 0.15 * 4e-3;
    const auto run = [&](SoftIntegrator kind, double h, double until) {
        Integrator integrator = make_integrator(kind);
        SchemeState state{0.0, {amplitude_exact}, {0.0}, {bead.acceleration(amplitude_exact, 0.0)}};
        if (auto* numerov = std::get_if<Numerov>(&integrator)) {
            const double before = amplitude_exact * std::cos(bead.w * h);
            numerov->memory = {h, before, -bead.w * bead.w * before, state.a[0]};
        }
        double largest = 0.0;
        double error = 0.0;
        while (state.time < until - 0.5 * h) {
            std::visit([&](auto& scheme) { scheme.step(bead, state, h); }, integrator);
            largest = std::fmax(largest, std::abs(state.x[0]));
            if (state.time < 0.4) continue;
            error = std::fmax(error, std::abs(state.x[0] - amplitude_exact * std::cos(bead.w * state.time)));
        }
        return std::pair{largest / amplitude_exact, error / amplitude_exact};
    };
    EXPECT_GT(run(SoftIntegrator::velocity_verlet, 3.5e-3, 0.45).first, 1e10);
    EXPECT_LT(run(SoftIntegrator::numerov_central, 3.5e-3, 0.45).first, 1.2);
    EXPECT_GT(run(SoftIntegrator::numerov_central, 4.2e-3, 0.45).first, 1e10);
    const double verlet = run(SoftIntegrator::velocity_verlet, 1e-4, 0.45).second;
    const double numerov = run(SoftIntegrator::numerov_central, 1e-4, 0.45).second;
    const double verlet_coarse = run(SoftIntegrator::velocity_verlet, 1e-3, 0.45).second;
    const double numerov_coarse = run(SoftIntegrator::numerov_central, 1e-3, 0.45).second;
    fmt::print(
        "error over amplitude at 0.1 ms: Verlet {:.3g} (0.042), Numerov {:.2g} (7.7e-6); at 1 ms {:.3g} (1.84), "
        "{:.3g} (0.077)\n",
        verlet, numerov, verlet_coarse, numerov_coarse);
    EXPECT_NEAR(verlet, 0.042, 5e-4);
    EXPECT_NEAR(numerov, 7.7e-6, 3e-7);
    EXPECT_NEAR(verlet_coarse, 1.84, 0.02);
    EXPECT_NEAR(numerov_coarse, 0.077, 1e-3);
}

}  // namespace
}  // namespace polargrain
