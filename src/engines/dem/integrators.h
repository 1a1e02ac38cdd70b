#pragma once

#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "src/model/dem_settings.h"

namespace polargrain {

/// Coordinates, their rates and accelerations at one instant; any units.
struct SchemeState {
    double time = 0.0;  ///< [s]
    std::vector<double> x, v, a;
};

// Schemes for x'' = a(t, x, v) [S13; their formulas stand at each]. Each is a closed step function on equations that
// offer
//   accelerations(time, x, v, a)           a is filled in
//   accept(time, x)                        the state of a finished step: what depends on history moves on
//   solve_implicit(factor, residual, dx)   (1 - factor da/dx) dx = residual, for the implicit scheme only
// A step begins with a = a(t, x, v) in the state and leaves it so. What a scheme remembers beyond the state is in
// `memory`, one array after the other, so that a checkpoint can keep it; empty memory starts anew from the state.

/// v += a h; x += v h. First order, but with the energy behaviour of the second.
struct SymplecticEuler {
    std::vector<double> memory;

    template <typename Equations>
    void step(Equations& equations, SchemeState& s, double h) {
        for (std::size_t k = 0; k < s.x.size(); ++k) {
            s.v[k] += h * s.a[k];
            s.x[k] += h * s.v[k];
        }
        s.time += h;
        equations.accelerations(s.time, s.x, s.v, s.a);
        equations.accept(s.time, s.x);
    }
};

/// x += v h + a h^2 / 2; v += a h.
struct TaylorSeries {
    std::vector<double> memory;

    template <typename Equations>
    void step(Equations& equations, SchemeState& s, double h) {
        for (std::size_t k = 0; k < s.x.size(); ++k) {
            s.x[k] += h * (s.v[k] + 0.5 * h * s.a[k]);
            s.v[k] += h * s.a[k];
        }
        s.time += h;
        equations.accelerations(s.time, s.x, s.v, s.a);
        equations.accept(s.time, s.x);
    }
};

/// x+ = 2 x - x- + a h^2, dashpots with the velocity (x - x-) / h. Memory: h, then x-.
struct PositionVerlet {
    std::vector<double> memory;

    template <typename Equations>
    void step(Equations& equations, SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        if (memory.size() != n + 1 || memory[0] != h) {
            memory.assign(1, h);
            for (std::size_t k = 0; k < n; ++k) memory.push_back(s.x[k] - h * (s.v[k] - 0.5 * h * s.a[k]));
        }
        backward_.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            const double next = 2.0 * s.x[k] - memory[k + 1] + h * h * s.a[k];
            memory[k + 1] = s.x[k];
            backward_[k] = (next - s.x[k]) / h;
            s.x[k] = next;
        }
        s.time += h;
        equations.accelerations(s.time, s.x, backward_, s.a);
        equations.accept(s.time, s.x);
        for (std::size_t k = 0; k < n; ++k) s.v[k] = backward_[k] + 0.5 * h * s.a[k];
    }

private:
    std::vector<double> backward_;
};

/// x += v h + a h^2 / 2; a' = a(x, v + f a h); v += (a + a') h / 2. With f = 1/2, as in [S13, eq. 11], the dashpot sees
/// a velocity half a step old and the scheme is of first order; with f = 1 of second.
struct VelocityVerlet {
    std::vector<double> memory;
    double foresight = 1.0;  ///< f

    template <typename Equations>
    void step(Equations& equations, SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        half_.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            half_[k] = s.v[k] + 0.5 * h * s.a[k];
            s.x[k] += h * half_[k];
            s.v[k] += foresight * h * s.a[k];
        }
        s.time += h;
        equations.accelerations(s.time, s.x, s.v, s.a);
        equations.accept(s.time, s.x);
        for (std::size_t k = 0; k < n; ++k) s.v[k] = half_[k] + 0.5 * h * s.a[k];
        // Equations that know what work their forces should have done mend the second kick.
        if constexpr (requires { equations.balance_work(h, s.v); }) equations.balance_work(h, s.v);
    }

private:
    std::vector<double> half_;
};

/// Gear's predictor and corrector with four values: x, v, a and their rate. Memory: the rate of a.
struct Gear4 {
    std::vector<double> memory;

    template <typename Equations>
    void step(Equations& equations, SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        if (memory.size() != n) memory.assign(n, 0.0);
        for (std::size_t k = 0; k < n; ++k) {
            const double rate = memory[k];
            s.x[k] += h * (s.v[k] + h * (s.a[k] / 2.0 + h * rate / 6.0));
            s.v[k] += h * (s.a[k] + h * rate / 2.0);
            s.a[k] += h * rate;
        }
        s.time += h;
        found_.resize(n);
        equations.accelerations(s.time, s.x, s.v, found_);
        for (std::size_t k = 0; k < n; ++k) {
            const double miss = found_[k] - s.a[k];
            s.x[k] += miss * h * h / 12.0;
            s.v[k] += 5.0 * miss * h / 12.0;
            s.a[k] += miss;
            memory[k] += miss / h;
        }
        equations.accept(s.time, s.x);
    }

private:
    std::vector<double> found_;
};

/// Numerov's implicit scheme, solved by Newton's method: x+ = 2 x - x- + (a+ + 10 a + a-) h^2 / 12 with accelerations
/// at zero velocity, less what dashpots add at the present instant with a velocity that is central (x+ - x-) / 2h,
/// forward (x+ - x) / h or backward (x - x-) / h. Memory: h, x-, then the accelerations at zero velocity at x- and x.
struct Numerov {
    enum class Damping : std::uint8_t { central, forward, backward };
    static constexpr int k_most_iterations = 12;  ///< contacts that open and close by turns never settle
    static constexpr double k_precise = 1e-11;    ///< of the largest way of the step
    static constexpr double k_round_off = 1e-15;  ///< of the largest coordinate

    std::vector<double> memory;
    Damping damping = Damping::central;

    template <typename Equations>
    void step(Equations& equations, SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        still_.assign(n, 0.0);
        a_next_.resize(n);
        if (memory.size() != 3 * n + 1 || memory[0] != h) start(equations, s, h);
        double* before = memory.data() + 1;
        double* a_before = before + n;
        double* a_now = a_before + n;
        next_.resize(n);
        double way = 0.0;
        double extent = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            next_[k] = 2.0 * s.x[k] - before[k] + h * h * s.a[k];
            way = std::fmax(way, std::abs(next_[k] - s.x[k]));
            extent = std::fmax(extent, std::abs(s.x[k]));
        }
        for (int iteration = 0; iteration < k_most_iterations; ++iteration) {
            add_dashpots(equations, s, h);
            equations.accelerations(s.time + h, next_, still_, a_next_);
            residual_.resize(n);
            for (std::size_t k = 0; k < n; ++k) {
                residual_[k] = 2.0 * s.x[k] - before[k] +
                               h * h * ((a_next_[k] + 10.0 * a_now[k] + a_before[k]) / 12.0 + dashpots_[k]) - next_[k];
            }
            change_.resize(n);
            equations.solve_implicit(h * h / 12.0, residual_, change_);
            double largest = 0.0;
            for (std::size_t k = 0; k < n; ++k) {
                next_[k] += change_[k];
                largest = std::fmax(largest, std::abs(change_[k]));
            }
            if (!(largest > std::fmax(k_precise * way, k_round_off * extent))) break;
        }
        finish(equations, s, h);
    }

private:
    template <typename Equations>
    void start(Equations& equations, const SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        std::vector<double> before(n);
        for (std::size_t k = 0; k < n; ++k) before[k] = s.x[k] - h * (s.v[k] - 0.5 * h * s.a[k]);
        std::vector<double> a_before(n);
        equations.accelerations(s.time - h, before, still_, a_before);
        std::vector<double> a_now(n);
        equations.accelerations(s.time, s.x, still_, a_now);
        memory.assign(1, h);
        memory.insert(memory.end(), before.begin(), before.end());
        memory.insert(memory.end(), a_before.begin(), a_before.end());
        memory.insert(memory.end(), a_now.begin(), a_now.end());
    }

    /// Acceleration that dashpots add at the present positions.
    template <typename Equations>
    void add_dashpots(Equations& equations, const SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        const double* before = memory.data() + 1;
        const double* a_now = before + 2 * n;
        velocity_.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            switch (damping) {
                case Damping::central: velocity_[k] = (next_[k] - before[k]) / (2.0 * h); break;
                case Damping::forward: velocity_[k] = (next_[k] - s.x[k]) / h; break;
                case Damping::backward: velocity_[k] = (s.x[k] - before[k]) / h; break;
            }
        }
        dashpots_.resize(n);
        equations.accelerations(s.time, s.x, velocity_, dashpots_);
        for (std::size_t k = 0; k < n; ++k) dashpots_[k] -= a_now[k];
    }

    template <typename Equations>
    void finish(Equations& equations, SchemeState& s, double h) {
        const std::size_t n = s.x.size();
        double* before = memory.data() + 1;
        for (std::size_t k = 0; k < n; ++k) {
            s.v[k] = (next_[k] - s.x[k]) / h + 0.5 * h * s.a[k];
            before[k] = s.x[k];
            before[n + k] = before[2 * n + k];
        }
        s.x = next_;
        s.time += h;
        equations.accelerations(s.time, s.x, still_, a_next_);
        std::copy(a_next_.begin(), a_next_.end(), memory.begin() + 1 + static_cast<std::ptrdiff_t>(2 * n));
        equations.accelerations(s.time, s.x, s.v, s.a);
        equations.accept(s.time, s.x);
    }

    std::vector<double> still_, next_, a_next_, velocity_, dashpots_, residual_, change_;
};

using Integrator = std::variant<SymplecticEuler, TaylorSeries, PositionVerlet, VelocityVerlet, Gear4, Numerov>;

inline Integrator make_integrator(SoftIntegrator kind) {
    switch (kind) {
        case SoftIntegrator::symplectic_euler: return SymplecticEuler{};
        case SoftIntegrator::taylor: return TaylorSeries{};
        case SoftIntegrator::position_verlet: return PositionVerlet{};
        case SoftIntegrator::velocity_verlet: break;
        case SoftIntegrator::velocity_verlet_half: {
            VelocityVerlet half;
            half.foresight = 0.5;
            return half;
        }
        case SoftIntegrator::gear4: return Gear4{};
        case SoftIntegrator::numerov_central: return Numerov{};
        case SoftIntegrator::numerov_forward: {
            Numerov forward;
            forward.damping = Numerov::Damping::forward;
            return forward;
        }
        case SoftIntegrator::numerov_backward: {
            Numerov backward;
            backward.damping = Numerov::Damping::backward;
            return backward;
        }
    }
    return VelocityVerlet{};
}

}  // namespace polargrain
