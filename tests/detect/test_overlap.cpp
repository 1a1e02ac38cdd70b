#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shapes/shape_spec.h"
#include "src/core/random.h"
#include "src/detect/overlap.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::count_overlaps;

Scene one_of_each() {
    Scene scene = testing::empty_scene(0.0, 0.0);
    testing::add_rectangle(scene, 0.04, 0.02);
    testing::add_disk(scene, 0.012);
    testing::add_star(scene, 0.02, 0.005, 5);
    testing::add_stick(scene, 0.05, 0.006);
    testing::add_rough(scene, 0.015, 0.3, 1);
    testing::add_rough(scene, 0.004, 0.2, 2);
    testing::add_rectangle(scene, 0.06, 0.004);
    testing::add_disk(scene, 0.001);
    return scene;
}

TEST(Overlap, AgreesWithAnIndependentIntersectionTestOnRandomPairs) {
    Scene scene = one_of_each();
    constexpr std::uint64_t seed = 41;
    RandomStream random(seed, RandomPurpose::test);
    const auto shapes = static_cast<double>(scene.shapes.size());
    int overlapping = 0;
    for (int n = 0; n < 40000; ++n) {
        scene.grains = {};
        for (int k = 0; k < 2; ++k) {
            Grain grain;
            grain.shape = static_cast<ShapeIndex>(random.uniform() * shapes);
            grain.position = {random.uniform(-0.025, 0.025), random.uniform(-0.025, 0.025)};
            grain.angle = random.uniform(-10.0, 10.0);
            scene.add(grain);
        }
        const bool found = overlap(scene.shape_of(0), scene.grains.pose(0), scene.shape_of(1), scene.grains.pose(1));
        EXPECT_EQ(found, overlap(scene.shape_of(1), scene.grains.pose(1), scene.shape_of(0), scene.grains.pose(0)));
        // A pair that just touches may go either way within the tolerances.
        if (count_overlaps(scene, scene.grains, 0.0, 1e-8) != count_overlaps(scene, scene.grains, 0.0, 0.0)) continue;
        ASSERT_EQ(found, count_overlaps(scene, scene.grains, 0.0, 1e-8) == 1) << "seed " << seed << ", pair " << n;
        overlapping += found ? 1 : 0;
    }
    EXPECT_GT(overlapping, 5000);
    EXPECT_LT(overlapping, 35000);
}

TEST(Overlap, OfWallPiecesAgreesWithAnIndependentTest) {
    Scene scene = one_of_each();
    RandomStream random(42, RandomPurpose::test);
    const auto shapes = static_cast<double>(scene.shapes.size());
    int overlapping = 0;
    for (int n = 0; n < 20000; ++n) {
        scene.grains = {};
        scene.walls.clear();
        Grain grain;
        grain.shape = static_cast<ShapeIndex>(random.uniform() * shapes);
        grain.position = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)};
        grain.angle = random.uniform(-10.0, 10.0);
        scene.add(grain);
        const Vec2 a{random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)};
        const Vec2 b{random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)};
        testing::add_wall(scene, "piece", {a, b});
        if (count_overlaps(scene, scene.grains, 0.0, 1e-8) != count_overlaps(scene, scene.grains, 0.0, 0.0)) continue;
        const bool found = overlap(scene.shape_of(0), scene.grains.pose(0), WallPiece{a, b});
        ASSERT_EQ(found, count_overlaps(scene, scene.grains, 0.0, 1e-8) == 1) << "seed 42, piece " << n;
        overlapping += found ? 1 : 0;
    }
    EXPECT_GT(overlapping, 2000);
}

TEST(Overlap, SeesADiskInsideABarFarFromItsMiddle) {
    Scene scene = testing::empty_scene(0.0, 0.0);
    scene.add(Grain{testing::add_rectangle(scene, 0.4, 0.1), 0, {0.0, 0.0}, 0.3});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0});
    const Shape& bar = scene.shape_of(0);
    const Shape& disk = scene.shape_of(1);
    const Pose middle = scene.grains.pose(0);
    const auto disk_at = [&](double along, double across) { return Pose::at(middle.to_world({along, across}), 0.0); };
    EXPECT_TRUE(overlap(bar, middle, disk, disk_at(0.15, 0.0)));
    EXPECT_TRUE(overlap(disk, disk_at(-0.15, 0.03), bar, middle));
    EXPECT_FALSE(overlap(bar, middle, disk, disk_at(0.15, 0.061)));
}

TEST(Overlap, SeesCrossedBarsWithoutAVertexInside) {
    Scene scene = testing::empty_scene(0.0, 0.0);
    const ShapeIndex bar = testing::add_rectangle(scene, 0.1, 0.01);
    scene.add(Grain{bar, 0, {0.0, 0.0}, 0.0});
    scene.add(Grain{bar, 0, {0.01, 0.005}, 0.5 * k_pi});
    EXPECT_TRUE(overlap(scene.shape_of(0), scene.grains.pose(0), scene.shape_of(1), scene.grains.pose(1)));
}

TEST(Overlap, SeesAlignedSquaresAndNotTouchingOnes) {
    Scene scene = testing::empty_scene(0.0, 0.0);
    const Shape square = scene.shape(testing::add_rectangle(scene, 0.02, 0.02));
    const auto shifted = [&](double dx, double dy) {
        return overlap(square, Pose::at({0.0, 0.0}, 0.0), square, Pose::at({dx, dy}, 0.0));
    };
    EXPECT_TRUE(shifted(0.0, 0.0));
    EXPECT_TRUE(shifted(0.01, 0.0));
    EXPECT_TRUE(shifted(0.02 - 1e-9, 0.0));
    EXPECT_FALSE(shifted(0.02, 0.0)) << "faces that coincide touch";
    EXPECT_FALSE(shifted(0.02, 0.007));
    EXPECT_FALSE(shifted(0.02, 0.02)) << "corners that coincide touch";
}

TEST(Overlap, SeesAGrainInsideAnother) {
    Scene scene = testing::empty_scene(0.0, 0.0);
    const Shape large = scene.shape(testing::add_star(scene, 0.1, 0.03, 6));
    const Shape small = scene.shape(testing::add_rectangle(scene, 0.004, 0.004));
    EXPECT_TRUE(overlap(large, Pose::at({0.0, 0.0}, 0.0), small, Pose::at({0.08, 0.0}, 0.3)));
    EXPECT_FALSE(overlap(large, Pose::at({0.0, 0.0}, 0.0), small, Pose::at({0.0, 0.09}, 0.3))) << "in a notch";
}

}  // namespace
}  // namespace polargrain
