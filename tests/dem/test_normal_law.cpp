#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "src/engines/dem/normal_law.h"
#include "tests/dem/impact_by_law.h"

namespace polargrain {
namespace {

using testing::collide;
using testing::Impact;
using testing::largest_overlap;

constexpr double k_pi_exact = std::numbers::pi;

struct Oscillator {
    double k = 1e5;
    double m = 0.01;
    double rate() const { return std::sqrt(k / m); }
    double fine_step() const { return k_pi_exact / rate() / 20000.0; }
};

class LinearLaw : public ::testing::TestWithParam<double> {};

TEST_P(LinearLaw, WithTensionGivesItsClosedFormsAtEverySpeed) {
    const double e = GetParam();
    const Oscillator o;
    const double gamma = damping_ratio_with_tension(e);
    const double s = std::sqrt(1.0 - gamma * gamma);
    const double c = 2.0 * gamma * std::sqrt(o.k * o.m);
    for (const double speed : {0.01, 1.0, 7.0}) {
        const Impact impact =
            collide([&](double x, double v) { return damped_force(linear_spring(x, o.k).force, c, v, true); }, o.m,
                    speed, o.fine_step());
        EXPECT_NEAR(impact.duration / (k_pi_exact / (o.rate() * s)), 1.0, 1e-6);
        EXPECT_NEAR(impact.largest / (speed / o.rate() * std::exp(-gamma / s * std::acos(gamma))), 1.0, 1e-6);
        EXPECT_NEAR(impact.restitution / e, 1.0, 1e-6);
    }
}

TEST_P(LinearLaw, WithoutTensionGivesItsClosedFormsAtEverySpeed) {
    const double e = GetParam();
    const Oscillator o;
    const double gamma = damping_ratio_without_tension(e);
    const double s = std::sqrt(1.0 - gamma * gamma);
    const double c = 2.0 * gamma * std::sqrt(o.k * o.m);
    for (const double speed : {0.01, 1.0, 7.0}) {
        const Impact impact =
            collide([&](double x, double v) { return damped_force(linear_spring(x, o.k).force, c, v, false); }, o.m,
                    speed, o.fine_step());
        const double duration = (k_pi_exact - 2.0 * std::asin(gamma)) / (o.rate() * s);
        EXPECT_NEAR(impact.duration / duration, 1.0, 1e-3);
        EXPECT_NEAR(impact.restitution / e, 1.0, 1e-4);
    }
}

TEST(DampingRatio, MadeForTensionGivesTooMuchWithoutIt) {
    const Oscillator o;
    for (const auto& [asked, got] : {std::pair{0.9, 0.9020}, {0.8, 0.8081}, {0.5, 0.5503}, {0.2, 0.3249}}) {
        const double c = 2.0 * damping_ratio_with_tension(asked) * std::sqrt(o.k * o.m);
        const Impact impact =
            collide([&](double x, double v) { return damped_force(linear_spring(x, o.k).force, c, v, false); }, o.m,
                    1.0, o.fine_step());
        EXPECT_NEAR(impact.restitution, got, 6e-5) << asked;
    }
}

INSTANTIATE_TEST_SUITE_P(Restitutions, LinearLaw, ::testing::Values(0.99, 0.9, 0.8, 0.5, 0.2));

TEST(DampingRatio, IsTheTableOfKuoAndOthers) {
    const std::pair<double, double> table[] = {{0.9, 0.0335}, {0.8, 0.0709},  {0.7, 0.1128}, {0.6, 0.1605},
                                               {0.5, 0.2155}, {0.4, 0.2800},  {0.3, 0.3579}, {0.2, 0.4559},
                                               {0.1, 0.5912}, {0.001, 0.9103}};
    for (const auto& [e, gamma] : table) EXPECT_NEAR(damping_ratio_with_tension(e), gamma, 6e-5) << e;
}

TEST(DampingRatio, WithoutTensionIsTheSolvedTableAndIsCriticalAtExpMinusTwo) {
    const std::pair<double, double> table[] = {{0.9, 0.03427}, {0.8, 0.07436}, {0.5, 0.25528}, {0.2, 0.73125}};
    for (const auto& [e, gamma] : table) EXPECT_NEAR(damping_ratio_without_tension(e), gamma, 6e-6) << e;
    EXPECT_NEAR(damping_ratio_without_tension(std::exp(-2.0)), 1.0, 1e-9);
    EXPECT_NEAR(damping_ratio_without_tension(std::exp(-2.0) * (1.0 - 1e-9)), 1.0, 1e-5);
    EXPECT_DOUBLE_EQ(damping_ratio_without_tension(1.0), 0.0);
}

TEST(DampingRatio, AboveCriticalStillGivesTheRestitution) {
    const Oscillator o;
    for (const double e : {0.1, 0.03}) {
        const double c = 2.0 * damping_ratio_without_tension(e) * std::sqrt(o.k * o.m);
        const Impact impact =
            collide([&](double x, double v) { return damped_force(linear_spring(x, o.k).force, c, v, false); }, o.m,
                    1.0, 0.2 * o.fine_step());
        EXPECT_NEAR(impact.restitution / e, 1.0, 1e-3);
    }
}

TEST(LinearSteelSpheres, TakeFourPointSixMicrosecondsAndNineHundredthsOfAPercent) {
    // Two steel spheres at 1 m/s [W93]: w = 6.8e5 /s, mu = 2.29e4 /s with m = 0.69e-5 kg; k follows.
    constexpr double m = 0.69e-5;
    const double damped = 6.8e5;
    const double mu = 2.29e4;
    const double k = m * (damped * damped + mu * mu);
    EXPECT_NEAR(k, 3.19e6, 0.01e6);
    const Impact impact =
        collide([&](double x, double v) { return damped_force(linear_spring(x, k).force, 2.0 * m * mu, v, true); }, m,
                1.0, 1e-10);
    const double radius = std::cbrt(3.0 * 2.0 * m / (4.0 * k_pi_exact * 7800.0));
    fmt::print("{:.4g} us, e {:.4f}, overlap over diameter {:.4f} %\n", 1e6 * impact.duration, impact.restitution,
               100.0 * impact.largest / (2.0 * radius));
    EXPECT_NEAR(1e6 * impact.duration, 4.62, 0.005);
    EXPECT_NEAR(impact.restitution, 0.8996, 2e-4);
    EXPECT_NEAR(100.0 * impact.largest / (2.0 * radius), 0.0930, 0.001);
}

class PowerLaw : public ::testing::TestWithParam<double> {};

TEST_P(PowerLaw, GivesDurationAndOverlapInClosedForm) {
    const double b = GetParam();
    constexpr double k = 2e7;
    constexpr double m = 0.02;
    const double share = 1.0 / (2.0 + b);
    const double g = 2.0 * std::sqrt(k_pi_exact) * std::tgamma(1.0 + share) / std::tgamma(0.5 + share);
    for (const double speed : {0.02, 0.5, 3.0}) {
        const double deepest = largest_overlap(m, speed, k, b);
        const Impact impact =
            collide([&](double x, double) { return power_spring(x, k, b).force; }, m, speed, deepest / speed / 5000.0);
        EXPECT_NEAR(impact.largest / deepest, 1.0, 1e-6);
        EXPECT_NEAR(impact.duration / (g * deepest / speed), 1.0, 1e-5);
        EXPECT_NEAR(impact.restitution, 1.0, 1e-5);
    }
}

TEST_P(PowerLaw, HasOneRestitutionAtAllSpeedsUnderProportionalDamping) {
    const double b = GetParam();
    constexpr double k = 2e7;
    constexpr double m = 0.02;
    for (const double e : {0.9, 0.6}) {
        for (const bool tension : {true, false}) {
            const double gamma = tension ? damping_ratio_with_tension(e) : damping_ratio_without_tension(e);
            const double constant = damping_constant(gamma, m, k, b, 0.5 * b, 1e-3);
            double worst = 0.0;
            for (const double speed : {0.05, 3.0}) {
                const double dt = largest_overlap(m, speed, k, b) / speed / 20000.0;
                const Impact impact = collide(
                    [&](double x, double v) {
                        const Elastic elastic = power_spring(x, k, b);
                        const double damping = proportional_damping(elastic, gamma, m);
                        if (x > 0.0)
                            worst = std::fmax(worst, std::abs(damping / (constant * std::pow(x, 0.5 * b)) - 1.0));
                        return damped_force(elastic.force, damping, v, tension);
                    },
                    m, speed, dt);
                EXPECT_NEAR(impact.restitution / e, 1.0, 2e-3) << "b " << b << " tension " << tension;
            }
            EXPECT_LT(worst, 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Exponents, PowerLaw, ::testing::Values(0.0, 0.25, 0.5, 1.0));

TEST(Hertz, SpheresTakeTheTimeOfTheClosedForm) {
    // T = 2.8683 (m^2 / (R E^2 V))^(1/5), largest overlap (15 m V^2 / (16 sqrt(R) E))^(2/5).
    constexpr double modulus = 1.1e11;
    constexpr double radius = 2.5e-3;
    constexpr double m = 2.6e-4;
    const double k = 4.0 / 3.0 * modulus * std::sqrt(radius);
    for (const double speed : {0.1, 1.0, 10.0}) {
        const double duration = 2.8683 * std::pow(m * m / (radius * modulus * modulus * speed), 0.2);
        const Impact impact =
            collide([&](double x, double) { return hertz_spring(x, k).force; }, m, speed, duration / 20000.0);
        EXPECT_NEAR(impact.duration / duration, 1.0, 2e-5);
        EXPECT_NEAR(impact.largest / std::pow(15.0 * m * speed * speed / (16.0 * std::sqrt(radius) * modulus), 0.4),
                    1.0, 1e-6);
    }
}

TEST(Hertz, TsujisDampingGivesHisRestitutionAtEverySpeed) {
    constexpr double k = 1e9;
    constexpr double m = 1e-3;
    for (const auto& [alpha, e] : {std::pair{0.07, 0.90629}, {0.3, 0.65355}}) {
        for (const double speed : {0.1, 4.0}) {
            const Impact impact = collide(
                [&](double x, double v) {
                    const double d = alpha * std::sqrt(m * k) * std::sqrt(std::sqrt(x));
                    return damped_force(hertz_spring(x, k).force, d, v, true);
                },
                m, speed, largest_overlap(m, speed, k, 0.5) / speed / 20000.0);
            EXPECT_NEAR(impact.restitution, e, 1e-5);
            // Our damping ratio is the same thing: alpha = sqrt(5) gamma.
            EXPECT_NEAR(damping_ratio_with_tension(e) * std::sqrt(5.0), alpha, 2e-5);
        }
    }
}

TEST(Hertz, LossChangesWithSpeedByThePowerOfTheDampingExponent) {
    // 1 - e ~ V^((2 g - b) / (2 + b)): falls with speed for g = 0, rises for g = 1/2 (Kuwabara and Kono).
    constexpr double k = 1e9;
    constexpr double m = 1e-3;
    for (const auto& [g, slope] : {std::pair{0.0, -0.2}, {0.25, 0.0}, {0.5, 0.2}}) {
        const auto loss = [&](double speed) {
            const double d = damping_constant(1e-3, m, k, 0.5, g, largest_overlap(m, 1.0, k, 0.5));
            const Impact impact = collide(
                [&](double x, double v) { return damped_force(hertz_spring(x, k).force, d * std::pow(x, g), v, true); },
                m, speed, largest_overlap(m, speed, k, 0.5) / speed / 20000.0);
            return 1.0 - impact.restitution;
        };
        const double measured = std::log(loss(10.0) / loss(0.1)) / std::log(100.0);
        fmt::print("g {}: 1 - e ~ V^{:.4f} (exact {})\n", g, measured, slope);
        EXPECT_NEAR(measured, slope, 2e-3);
    }
}

TEST(WaltonBraun, GivesBackTheRootOfTheStiffnessRatio) {
    constexpr double m = 0.01;
    constexpr double k1 = 1e5;
    for (const double e : {0.9, 0.7, 0.4}) {
        const double k2 = k1 / (e * e);
        for (const double speed : {0.05, 2.0}) {
            double largest = 0.0;
            double lost = 0.0;
            const Impact impact = collide(
                [&](double x, double) {
                    const Hysteretic h = walton_braun_spring(x, largest, k1, k2);
                    largest = h.largest;
                    lost = h.lost;
                    return h.force;
                },
                m, speed, k_pi_exact * std::sqrt(m / k1) / 40000.0);
            EXPECT_NEAR(impact.restitution / e, 1.0, 2e-4);
            EXPECT_NEAR(impact.duration / (0.5 * k_pi_exact * (std::sqrt(m / k1) + std::sqrt(m / k2))), 1.0, 2e-3);
            EXPECT_NEAR(lost / (0.5 * m * speed * speed * (1.0 - e * e)), 1.0, 1e-3);
        }
    }
}

TEST(WaltonBraun, LoadsAgainAlongTheStiffBranchUpToWhereItWas) {
    const Hysteretic top = walton_braun_spring(1e-3, 0.0, 1e5, 4e5);
    EXPECT_DOUBLE_EQ(top.force, 100.0);
    const Hysteretic back = walton_braun_spring(0.9e-3, top.largest, 1e5, 4e5);
    EXPECT_NEAR(back.force, 60.0, 1e-9);
    EXPECT_NEAR(walton_braun_spring(1e-3, back.largest, 1e5, 4e5).force, 100.0, 1e-9);
    EXPECT_DOUBLE_EQ(walton_braun_spring(0.5e-3, top.largest, 1e5, 4e5).force, 0.0);
    EXPECT_NEAR(top.energy + top.lost, 0.5 * 1e5 * 1e-6, 1e-15);
}

}  // namespace
}  // namespace polargrain
