#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "src/core/elementary.h"
#include "src/observe/bed.h"
#include "src/observe/toppling_meter.h"

namespace polargrain {
namespace {

/// A box ten diameters wide with `rows` rows of disks of radius 10 mm on a square lattice.
Scene square_lattice(int rows) {
    Scene scene;
    scene.materials.add({"stone", 2000.0, {}, 0.0});
    scene.gravity = {0.0, -9.81};
    scene.walls.push_back({"box", 0, {{0.0, 1.0}, {0.0, 0.0}, {0.2, 0.0}, {0.2, 1.0}}, {}, std::nullopt});
    const ShapeIndex disk = scene.add(std::make_shared<const Shape>(Disk("disk", 0.01)));
    for (int k = 0; k < 10 * rows; ++k) {
        scene.add(Grain{disk, 0, {0.01 + 0.02 * (k % 10), 0.01 + 0.02 * (k / 10)}});
    }
    return scene;
}

TEST(AreaFraction, OfASquareLatticeIsAQuarterOfPi) {
    for (const int rows : {1, 3, 12}) {
        const Scene scene = square_lattice(rows);
        EXPECT_NEAR(area_fraction(scene, scene.grains), 0.25 * k_pi, 1e-12) << rows << " rows";
    }
}

TEST(AreaFraction, LeavesOutWhatHasLeftAndKeepsToTheSurface) {
    Scene scene = square_lattice(4);
    for (std::size_t k = 30; k < 35; ++k) scene.grains.y[k] = -0.5;  // half of the top row is gone
    EXPECT_NEAR(area_fraction(scene, scene.grains), 0.25 * k_pi, 1e-12);
}

TEST(AreaFraction, IsTurnedWithGravity) {
    Scene scene = square_lattice(3);
    scene.gravity = {0.0, 9.81};
    for (auto& wall : scene.walls) {
        for (Vec2& p : wall.points) p = -p;
    }
    for (auto* values : {&scene.grains.x, &scene.grains.y}) {
        for (double& v : *values) v = -v;
    }
    EXPECT_NEAR(area_fraction(scene, scene.grains), 0.25 * k_pi, 1e-12);
}

TEST(AreaFraction, NeedsWallsAndGravity) {
    Scene scene = square_lattice(1);
    scene.gravity = Vec2::Zero();
    EXPECT_TRUE(std::isnan(area_fraction(scene, scene.grains)));
}

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

TEST(SurfaceSlope, OfALatticeUnderAStraightLineIsThatLine) {
    Scene scene = square_lattice(0);
    for (int column = 0; column < 10; ++column) {
        for (int k = 0; k < 3 + 2 * column; ++k) scene.add(Grain{0, 0, {0.01 + 0.02 * column, 0.01 + 0.02 * k}});
    }
    EXPECT_NEAR(surface_slope(scene, scene.grains, {}), std::atan(2.0), 1e-12);
    for (double& x : scene.grains.x) x = 0.2 - x;
    EXPECT_NEAR(surface_slope(scene, scene.grains, {}), -std::atan(2.0), 1e-12);
    EXPECT_NEAR(surface_slope(scene, scene.grains, Region{{0.0, 0.0}, {0.08, 1.0}}), -std::atan(2.0), 1e-12);
    EXPECT_TRUE(std::isnan(surface_slope(scene, scene.grains, Region{{0.0, 0.0}, {0.03, 1.0}})));
}

TEST(TopplingMeter, MeasuresAWaveOfKnownSpeed) {
    // Ten disks 0.05 m apart, centres 0.02 m above the lowest point, toppled by a wave of 1.5 m/s.
    Scene scene = square_lattice(1);
    for (std::size_t k = 0; k < 10; ++k) {
        scene.grains.x[k] = 0.05 * static_cast<double>(k);
        scene.grains.y[k] = 0.02;
    }
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

}  // namespace
}  // namespace polargrain
