#include <gtest/gtest.h>

#include <cmath>

#include "src/observe/stress.h"
#include "tests/observe/observed.h"

namespace polargrain::testing {
namespace {

const Totals k_nothing;

/// A column of n disks of radius 0.01 on the floor of a box 0.02 wide, each carrying all above it for a step of dt.
struct Column {
    Scene scene;
    StepReport report;

    Column(int n, double dt) {
        std::vector<Vec2> places;
        for (int k = 0; k < n; ++k) places.emplace_back(0.01, 0.01 + 0.02 * k);
        scene = disks_at(places);
        add_open_box(scene, 0.02, 1.0);
        report.clear(1);
        const double weight = scene.grains.mass[0] * 9.81;
        report.contacts.push_back(press(scene, 0, 0, Vec2(0.01, 0.0), n * weight * dt));
        for (int k = 1; k < n; ++k) report.contacts.push_back(press(scene, k - 1, k, (n - k) * weight * dt));
    }
};

TEST(ContactStress, OfAColumnIsItsWeightOverItsWidth) {
    constexpr int k_grains = 20;
    constexpr double k_dt = 1e-3;
    const Column column(k_grains, k_dt);
    // Between the centres of grains 5 and 10: contacts 6 to 10 with one branch each.
    StressMeter meter({{0.0, 0.11}, {0.02, 0.21}}, StressMeter::Component::yy);
    const World world = initial_world(column.scene);
    meter.step(world, k_dt, column.report);
    meter.step(world, k_dt, column.report);
    const double weight = column.scene.grains.mass[0] * 9.81;
    const double mean_load = (k_grains - 8) * weight;  // on contacts 6, 7, 8, 9, 10
    EXPECT_NEAR(meter.read({column.scene, world, column.report, k_nothing}), mean_load / 0.02, 1e-9 * mean_load);
    EXPECT_TRUE(std::isnan(meter.read({column.scene, world, column.report, k_nothing}))) << "the interval is over";
}

TEST(ContactStress, OfPushesAlongTheDiagonalHasAShearPart) {
    const Scene scene = disks_at({{0.0, 0.0}, {0.01, 0.01}});
    StepReport report;
    report.contacts.push_back(press(scene, 0, 1, 1.0));
    StressMeter meter({{-1.0, -1.0}, {1.0, 1.0}}, StressMeter::Component::xy);
    meter.step(initial_world(scene), 0.5, report);
    const SymmetricTensor stress = meter.stress();
    const double expected = 1.0 / 0.5 * std::sqrt(2.0) * 0.01 / 4.0 / 2.0;  // force x branch / area, half of it each
    EXPECT_NEAR(stress.xx, expected, 1e-12);
    EXPECT_NEAR(stress.yy, expected, 1e-12);
    EXPECT_NEAR(stress.xy, expected, 1e-12);
}

TEST(WallMeter, GivesThePressureOfAJanssenProfile) {
    // Grains against an upright wall push with p(z) = p0 (1 - exp(-z / h)) x their height.
    constexpr double k_p0 = 50.0, k_h = 0.2, k_dt = 1e-3, k_grain = 0.002;
    std::vector<Vec2> places;
    for (int k = 0; k < 500; ++k) places.emplace_back(0.001, 0.001 + k_grain * k);
    Scene scene = disks_at(places, 0.001);
    add_open_box(scene, 0.02, 1.0);
    StepReport report;
    for (GrainIndex k = 0; k < 500; ++k) {
        const double depth = 1.0 - scene.grains.y[Grains::at(k)];
        const double pressure = k_p0 * (1.0 - std::exp(-depth / k_h));
        report.contacts.push_back(
            press(scene, 0, k, Vec2(0.0, scene.grains.y[Grains::at(k)]), pressure * k_grain * k_dt));
    }
    const World world = initial_world(scene);
    const auto mean_pressure = [&](double top, double bottom) {
        WallMeter meter(0, Region{{-0.01, 1.0 - bottom}, {0.01, 1.0 - top}}, WallMeter::Measure::pressure);
        meter.step(world, k_dt, report);
        return meter.read({scene, world, report, k_nothing});
    };
    const auto exact = [&](double top, double bottom) {
        const double tail = k_h * (std::exp(-top / k_h) - std::exp(-bottom / k_h));
        return k_p0 * (1.0 - tail / (bottom - top));
    };
    EXPECT_NEAR(mean_pressure(0.1, 0.2), exact(0.1, 0.2), 0.01 * k_p0);
    EXPECT_NEAR(mean_pressure(0.6, 0.9), exact(0.6, 0.9), 0.01 * k_p0);
    EXPECT_NEAR(mean_pressure(0.6, 0.9), k_p0, 0.03 * k_p0) << "saturates";
}

TEST(WallMeter, TellsTheShareOfTheWeightThatAFloorCarries) {
    const Column column(7, 2e-3);
    WallMeter meter(0, std::nullopt, WallMeter::Measure::weight_share);
    const World world = initial_world(column.scene);
    meter.step(world, 2e-3, column.report);
    EXPECT_NEAR(meter.read({column.scene, world, column.report, k_nothing}), 1.0, 1e-12);
}

TEST(WallLength, IsClippedToTheRegionWhereTheWallIsNow) {
    Wall wall{"w", 0, {{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}}, {}, std::nullopt};
    EXPECT_DOUBLE_EQ(wall_length(wall, 0.0, {}), 3.0);
    EXPECT_DOUBLE_EQ(wall_length(wall, 0.0, Region{{0.5, -1.0}, {2.0, 0.5}}), 1.0);
    EXPECT_DOUBLE_EQ(wall_length(wall, 0.0, Region{{5.0, 5.0}, {6.0, 6.0}}), 0.0);
    wall.motion = RotationMotion{{0.0, 0.0}, 0.5 * k_pi, 0.0};  // a quarter turn in a second
    EXPECT_NEAR(wall_length(wall, 1.0, Region{{-0.1, 0.25}, {0.1, 0.75}}), 0.5, 1e-12);
}

}  // namespace
}  // namespace polargrain::testing
