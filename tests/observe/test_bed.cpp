#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "src/core/elementary.h"
#include "src/observe/bed.h"
#include "src/observe/toppling_meter.h"
#include "tests/observe/observed.h"
#include "tests/observe/square_lattice.h"

namespace polargrain {
namespace {

using testing::add_open_box;
using testing::disks_at;
using testing::square_lattice;

/// A box `columns` diameters wide with the rows of a hexagonal packing of disks of radius 10 mm, the outermost touching
/// the walls.
Scene hexagonal_bed(int columns, int rows) {
    Scene scene = square_lattice(0);
    scene.walls[0].points = {{0.0, 1.0}, {0.0, 0.0}, {0.02 * columns, 0.0}, {0.02 * columns, 1.0}};
    for (int row = 0; row < rows; ++row) {
        for (int k = 0; k < columns - row % 2; ++k) {
            scene.add(Grain{0, 0, {0.01 + 0.02 * k + 0.01 * (row % 2), 0.01 + std::sqrt(3.0) * 0.01 * row}});
        }
    }
    return scene;
}

TEST(PotentialOverHexagonal, OfAHexagonalPackingIsOne) {
    for (const int rows : {1, 2, 7}) {
        const Scene scene = hexagonal_bed(10, rows);
        EXPECT_NEAR(potential_over_hexagonal(scene, scene.grains), 1.0, 1e-12) << rows << " rows";
    }
}

TEST(PotentialOverHexagonal, OfATallSquareLatticeIsItsHeightOverTheHexagonal) {
    // n rows of ten at 0.02 k + 0.01 against rows of ten and nine in turn, sqrt(3) x 0.01 apart.
    constexpr int k_rows = 40;
    const Scene scene = square_lattice(k_rows);
    double least = 0.0;
    int left = 10 * k_rows;
    for (int row = 0; left > 0; ++row) {
        const int here = std::min(left, 10 - row % 2);
        least += here * (0.01 + std::sqrt(3.0) * 0.01 * row);
        left -= here;
    }
    EXPECT_NEAR(potential_over_hexagonal(scene, scene.grains), 10.0 * k_rows * 0.02 * k_rows / 2.0 / least, 1e-12);
}

/// Makes dominoes of the grains of a scene.
void make_dominoes(Scene& scene) {
    const std::vector<Vec2> outline = {{-0.003, -0.015}, {0.003, -0.015}, {0.003, 0.015}, {-0.003, 0.015}};
    scene.shapes.at(0) = std::make_shared<const Shape>(
        PolarPolygon("domino", outline, MassProperties{0.006 * 0.03, Vec2::Zero(), 1e-8}));
}

TEST(TopplingMeter, MeasuresAWaveOfKnownSpeed) {
    // Ten dominoes 0.05 m apart, centres 0.02 m above the lowest point, toppled by a wave of 1.5 m/s.
    Scene scene = square_lattice(1);
    for (std::size_t k = 0; k < 10; ++k) {
        scene.grains.x[k] = 0.05 * static_cast<double>(k);
        scene.grains.y[k] = 0.02;
    }
    make_dominoes(scene);
    TopplingMeter meter(scene);
    EXPECT_TRUE(std::isnan(meter.speed()));
    World world = initial_world(scene);
    constexpr double dt = 1e-5;
    for (world.step = 1; world.step < 50000; ++world.step) {
        world.time = static_cast<double>(world.step) * dt;
        for (std::size_t k = 0; k < 10; ++k) {
            if (1.5 * world.time >= scene.grains.x[k]) world.grains.angle[k] = -0.5;
        }
        meter.step(world, dt, {});
    }
    EXPECT_NEAR(meter.speed(), 1.5 / std::sqrt(9.81 * 0.04), 1e-3);
}

/// A row of 30 toppled by a wave whose first `slow` pitches take twice as long as the others, to the right or left.
TopplingMeter after_a_wave(int slow, bool leftwards, const TopplingMeter::Measure measure) {
    constexpr int count = 30;
    Scene scene = disks_at(std::vector<Vec2>(count, Vec2(0.0, 0.02)));
    add_open_box(scene, 2.0, 1.0);
    for (int k = 0; k < count; ++k) scene.grains.x[static_cast<std::size_t>(k)] = 0.05 * k;
    make_dominoes(scene);
    TopplingMeter meter(scene, measure);
    World world = initial_world(scene);
    for (int k = 0; k < count; ++k) {
        world.time += k == 0 ? 0.0 : k <= slow ? 0.06 : 0.03;
        world.grains.angle[static_cast<std::size_t>(leftwards ? count - 1 - k : k)] = leftwards ? 0.5 : -0.5;
        meter.step(world, 0.0, {});
    }
    return meter;
}

TEST(TopplingMeter, HasNoSpeedForGrainsThatAreNoDominoesInARow) {
    for (const bool rolling : {true, false}) {
        Scene scene = square_lattice(1);
        if (!rolling) {
            make_dominoes(scene);
            scene.grains.y[4] *= 1.3;  // lies on others
        }
        TopplingMeter meter(scene);
        World world = initial_world(scene);
        for (double& angle : world.grains.angle) {
            world.time += 0.03;
            angle = -0.5;
            meter.step(world, 0.0, {});
        }
        EXPECT_TRUE(std::isnan(meter.speed())) << (rolling ? "disks" : "a heap");
    }
}

TEST(TopplingMeter, CountsTheDominoesThatToppleBeforeTheWaveIsSteady) {
    for (const bool leftwards : {false, true}) {
        // The five pitches about domino n, from n - 2 to n + 3, hold a slow one up to n = slow + 1.
        for (const int slow : {0, 1, 4, 9}) {
            const TopplingMeter meter = after_a_wave(slow, leftwards, TopplingMeter::Measure::run_in);
            EXPECT_EQ(meter.run_in(), slow + 2) << slow << leftwards;
            EXPECT_NEAR(meter.speed(), 0.05 / 0.03 / std::sqrt(9.81 * 0.04), 1e-12);
        }
    }
}

}  // namespace
}  // namespace polargrain
