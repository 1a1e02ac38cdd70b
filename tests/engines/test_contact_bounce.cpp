#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shapes/outline.h"
#include "src/core/elementary.h"
#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

constexpr double k_g = 9.81;
constexpr double k_d = 0.02;

/// Regular hexagon of outer diameter k_d, a vertex straight below its centre.
ShapeIndex add_hexagon(Scene& scene) {
    std::vector<Vec2> points;
    const double x = 0.25 * k_d * std::numbers::sqrt3;
    for (const auto& [sx, y] :
         {std::pair{0.0, -0.5}, {1.0, -0.25}, {1.0, 0.25}, {0.0, 0.5}, {-1.0, 0.25}, {-1.0, -0.25}}) {
        points.emplace_back(sx * x, y * k_d);
    }
    return scene.add(std::make_shared<const Shape>(prepare_outline("hexagon", points)));
}

ShapeIndex add_body(Scene& scene, bool polygon) {
    return polygon ? add_hexagon(scene) : testing::add_disk(scene, 0.5 * k_d);
}

class Restitution : public ::testing::TestWithParam<std::tuple<double, bool>> {};

TEST_P(Restitution, ComesOutAsItWentInAgainstAWallAndInAPair) {
    const auto [e, polygon] = GetParam();
    Scene scene = testing::empty_scene(e, 0.3, 0.0);
    const ShapeIndex body = add_body(scene, polygon);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{body, 0, {0.0, 0.05}, 0.0, {0.0, -0.7}});
    // A vertex on the middle of a face, on the line of centres: the lower hexagon turns a face upwards.
    scene.add(Grain{body, 0, {0.5, 0.50}, k_pi / 6.0, {0.0, 0.5}});
    scene.add(Grain{body, 0, {0.5, 0.55}, 0.0, {0.0, -0.6}});
    Running sim(make_contact, scene);
    sim.run(0.1, 1e-3);
    const double wall = sim.world.grains.vy[0] / 0.7;
    const double pair = (sim.world.grains.vy[2] - sim.world.grains.vy[1]) / 1.1;
    fmt::print("e {}: wall {:.6f}, pair {:.6f}\n", e, wall, pair);
    EXPECT_NEAR(wall, e, 1e-9);
    EXPECT_NEAR(pair, e, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Coefficients, Restitution,
                         ::testing::Combine(::testing::Values(0.0, 0.3, 0.5, 0.8, 0.9, 1.0), ::testing::Bool()));

/// sqrt(height of the first rebound / drop), heights of the lowest point above the floor.
double rebound(double e, bool polygon, double drop, double dt) {
    Scene scene = testing::empty_scene(e, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{add_body(scene, polygon), 0, {0.0, 0.5 * k_d + drop}});
    Running sim(make_contact, scene);
    double top = 0.0;
    bool rising = false;
    while (sim.world.time < 3.0) {
        sim.step(dt);
        if (sim.world.grains.vy[0] > 0.0) rising = true;
        if (!rising) continue;
        // The top of the parabola that the grain is on, so that it does not fall between two steps.
        const double v = sim.world.grains.vy[0];
        top = std::fmax(top, sim.world.grains.y[0] - 0.5 * k_d + 0.5 * v * v / k_g);
        if (v < 0.0) break;
    }
    return std::sqrt(top / drop);
}

class ReboundHeight : public ::testing::TestWithParam<std::tuple<double, bool, double>> {};

TEST_P(ReboundHeight, IsTheSquareOfRestitution) {
    const auto [e, polygon, diameters] = GetParam();
    const double measured = rebound(e, polygon, diameters * k_d, 1e-3);
    fmt::print("drop {} d: sqrt(height ratio) {:.5f}, e {} ({:+.2f} %)\n", diameters, measured, e,
               100.0 * (measured / e - 1.0));
    // It bounces off a skin of a thousandth of its size, and rises from there.
    EXPECT_NEAR(measured / e, 1.0, 6e-4 / (e * e * diameters));
}

INSTANTIATE_TEST_SUITE_P(Coefficients, ReboundHeight,
                         ::testing::Combine(::testing::Values(0.3, 0.5, 0.7, 0.85, 1.0), ::testing::Bool(),
                                            ::testing::Values(0.5, 2.0, 20.0)));

class ElasticBouncing : public ::testing::TestWithParam<double> {};

TEST_P(ElasticBouncing, KeepsItsEnergyForFiveSeconds) {
    const double drop = GetParam() * k_d;
    Scene scene = testing::empty_scene(1.0, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, 0.5 * k_d), 0, {0.0, 0.5 * k_d + drop}});
    Running sim(make_contact, scene);
    sim.run(5.0, 1e-3);
    const double available = sim.weight() * drop;
    const double change = (sim.total_energy() - sim.start_energy) / available;
    fmt::print("drop {} d, {} bounces: energy changed by {:.2g} (< 1e-4), rises {:.2g}\n", GetParam(), sim.impacts,
               change, sim.ledger.rises / available);
    EXPECT_GT(sim.impacts, 10);
    EXPECT_LT(std::abs(change), 1e-4);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
}

INSTANTIATE_TEST_SUITE_P(Drops, ElasticBouncing, ::testing::Values(0.5, 2.0, 10.0));

TEST(BouncingBall, ComesToRestInTheZenoTime) {
    // sqrt(2 h / g) (1 + e) / (1 - e): the sum of a geometric series of flights.
    const double exact = std::sqrt(2.0 / k_g) * 1.8 / 0.2;
    EXPECT_NEAR(exact, 4.063713, 1e-6);
    Scene scene = testing::empty_scene(0.8, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 1.01}});
    Running sim(make_contact, scene);
    double last = 0.0;
    sim.run(6.0, 1e-4, [&] {
        if (std::abs(sim.world.grains.vy[0]) > 1e-6) last = sim.world.time;
    });
    fmt::print("came to rest after {:.4f} s, exact {:.4f}\n", last, exact);
    EXPECT_NEAR(last, exact, 5e-3);
}

TEST(Cradle, FirstPassOfThreeBallsIsTheProductOfTwoImpacts) {
    const double e = 0.9;
    Scene scene = testing::empty_scene(e, 0.0, 0.0);
    const ShapeIndex disk = testing::add_disk(scene, 0.01);
    scene.add(Grain{disk, 0, {0.0, 0.0}, 0.0, {1.0, 0.0}});
    scene.add(Grain{disk, 0, {0.03, 0.0}});
    scene.add(Grain{disk, 0, {0.0502, 0.0}});
    Running sim(make_contact, scene);
    // Over when the last ball has been struck; the first has not caught the second by then.
    sim.run(0.012, 1e-4);
    const double q = 0.5 * (1.0 + e);
    const auto& vx = sim.world.grains.vx;
    fmt::print("{:.6f} {:.6f} {:.6f}, exact {:.6f} {:.6f} {:.6f}\n", vx[0], vx[1], vx[2], 1.0 - q, q * (1.0 - q),
               q * q);
    EXPECT_NEAR(vx[0], 1.0 - q, 1e-9);
    EXPECT_NEAR(vx[1], q * (1.0 - q), 1e-9);
    EXPECT_NEAR(vx[2], q * q, 1e-9);
}

/// Quarter period, ratio of spins across the first impact, and the peaks that follow [fraction of alpha].
struct Rocking {
    double upright = 0.0;
    double spin_ratio = 0.0;
    std::vector<double> peaks;
};

Rocking rock(double dt) {
    const double alpha = std::atan2(0.1, 0.4);
    const double tilt = 0.5 * alpha;
    const double half_diagonal = 0.5 * std::hypot(0.1, 0.4);
    Scene scene = testing::empty_scene(0.0, 3.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    // Leaning to the right on its lower right corner, which is at the origin.
    scene.add(Grain{testing::add_rectangle(scene, 0.1, 0.4),
                    0,
                    {-half_diagonal * std::sin(alpha - tilt), half_diagonal * std::cos(alpha - tilt) + 1e-9},
                    -tilt});
    Running sim(make_contact, scene);
    Rocking result;
    const auto spin = [&] { return sim.world.grains.spin[0]; };
    double fastest = 0.0;
    double last_spin = 0.0;
    sim.run(1.5, dt, [&] {
        const double angle = sim.world.grains.angle[0];
        if (result.upright == 0.0) {
            fastest = std::fmax(fastest, spin());
            if (spin() < 0.99 * fastest && fastest > 0.5) {
                result.upright = sim.world.time;
                result.spin_ratio = spin() / fastest;
            }
        } else if (last_spin * spin() < 0.0 && std::abs(angle) > 0.05 * alpha && result.peaks.size() < 3) {
            result.peaks.push_back(std::abs(angle) / alpha);
        }
        last_spin = spin();
    });
    return result;
}

TEST(RockingBlock, FallsBackInItsQuarterPeriodAndLosesWhatHousnerSays) {
    const Rocking measured = rock(1e-4);
    fmt::print("upright after {:.5f} s (0.22084), spin ratio {:.5f} (0.91176), peaks", measured.upright,
               measured.spin_ratio);
    for (const double p : measured.peaks) fmt::print(" {:.5f}", p);
    fmt::print(" (0.38671 0.30640 0.24606)\n");
    // It turns about a corner that stands on the skin of 2e-4 m, so the angle left to fall is a little smaller.
    EXPECT_NEAR(measured.upright, 0.220836, 1.5e-3);
    EXPECT_NEAR(measured.spin_ratio, 0.911765, 1e-3);
    ASSERT_EQ(measured.peaks.size(), 3U);
    EXPECT_NEAR(measured.peaks[0], 0.38671, 0.01);
    EXPECT_NEAR(measured.peaks[1], 0.30640, 0.01);
    EXPECT_NEAR(measured.peaks[2], 0.24606, 0.01);
}

}  // namespace
}  // namespace polargrain
