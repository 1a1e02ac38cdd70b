#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "src/core/elementary.h"
#include "src/observe/free_surface.h"
#include "tests/observe/square_lattice.h"

namespace polargrain {
namespace {

using testing::square_lattice;

/// The area fraction of `rows` rows on a square lattice under the half circles on top of them.
double lattice_fraction(int rows) { return 0.5 * k_pi * rows / (2.0 * rows - 1.0 + 0.25 * k_pi); }

TEST(AreaFraction, OfASquareLatticeEndsAtTheRoundTopsOfItsDisks) {
    for (const int rows : {1, 3, 12}) {
        const Scene scene = square_lattice(rows);
        EXPECT_NEAR(area_fraction(scene, scene.grains), lattice_fraction(rows), 3e-4) << rows << " rows";
    }
    const Scene tall = square_lattice(2000);
    EXPECT_NEAR(area_fraction(tall, tall.grains), 0.25 * k_pi, 1e-4);
}

TEST(AreaFraction, LeavesOutWhatHasLeftAndKeepsToTheSurface) {
    Scene scene = square_lattice(4);
    for (std::size_t k = 30; k < 35; ++k) scene.grains.y[k] = -0.5;  // half of the top row is gone
    EXPECT_NEAR(area_fraction(scene, scene.grains),
                lattice_fraction(7) * (2.0 * 7 - 1.0 + 0.25 * k_pi) / (2.0 * 7 - 2.0 + 0.5 * k_pi), 3e-4);
}

TEST(AreaFraction, SeesPastTheGrainsOnTop) {
    // One disk in the middle of a box three diameters wide: two thirds of the floor lie open.
    Scene scene = square_lattice(0);
    scene.walls[0].points = {{0.0, 1.0}, {0.0, 0.0}, {0.06, 0.0}, {0.06, 1.0}};
    scene.add(Grain{0, 0, {0.03, 0.01}});
    EXPECT_NEAR(*area_under_tops(scene, scene.grains), 0.02 * 0.01 + 0.5 * k_pi * 1e-4, 1e-7);
}

TEST(AreaFraction, FollowsTheOutlineOfPolygons) {
    // A bar 40 mm wide and 10 mm tall with a notch 4.5 mm deep in its top, 20 mm wide at its mouth.
    const std::vector<Vec2> notched = {{-0.02, -0.005}, {0.02, -0.005}, {0.02, 0.005}, {0.01, 0.005},
                                       {0.0, 0.0005},   {-0.01, 0.005}, {-0.02, 0.005}};
    const double filled = 0.04 * 0.01 - 0.5 * 0.02 * 0.0045;
    Scene scene = square_lattice(0);
    const ShapeIndex bar = scene.add(
        std::make_shared<const Shape>(PolarPolygon("bar", notched, MassProperties{filled, Vec2::Zero(), 1e-8})));
    scene.add(Grain{bar, 0, {0.1, 0.005}});
    EXPECT_NEAR(area_fraction(scene, scene.grains), 1.0, 0.01);
    scene.grains.angle[0] = k_pi;  // on its back: no line from above reaches the notch
    EXPECT_NEAR(area_fraction(scene, scene.grains), filled / (0.04 * 0.01), 0.01);
}

TEST(AreaFraction, TakesNoLongerBetweenWallsThatAreFarApart) {
    // Two disks that touch and one 1000 km away, 6e9 lines from wall to wall.
    Scene scene = square_lattice(0);
    scene.walls[0].points = {{-1e6, 0.0}, {1e6, 0.0}};
    for (const double x : {-9.0, -8.98, 999999.0}) scene.add(Grain{0, 0, {x, 0.01}});
    EXPECT_NEAR(*area_under_tops(scene, scene.grains), 3.0 * (0.02 * 0.01 + 0.5 * k_pi * 1e-4), 1e-6);
    EXPECT_NEAR(surface_slope(scene, scene.grains, {}), 0.0, 1e-12);
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
    EXPECT_NEAR(area_fraction(scene, scene.grains), lattice_fraction(3), 3e-4);
}

TEST(AreaFraction, NeedsWallsAndGravity) {
    Scene scene = square_lattice(1);
    scene.gravity = Vec2::Zero();
    EXPECT_TRUE(std::isnan(area_fraction(scene, scene.grains)));
    EXPECT_FALSE(area_under_tops(scene, scene.grains));
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

}  // namespace
}  // namespace polargrain
