#include <gtest/gtest.h>

#include <cmath>

#include "src/model/contact_law.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::add_disk;
using testing::add_wall;

Scene two_materials(Restitution first, Restitution second) {
    Scene scene;
    scene.materials.add({"light", 1000.0, first, 0.4});
    scene.materials.add({"heavy", 3000.0, second, 0.9});
    const ShapeIndex disk = add_disk(scene, 0.01);
    scene.add(Grain{disk, 0});
    scene.add(Grain{disk, 1});
    add_wall(scene, "floor", {{0.0, 0.0}, {1.0, 0.0}});
    return scene;
}

TEST(ImpactRestitution, OfTwoGrainsIsCombinedByMass) {  // [HN94, eq. 46]
    const Scene scene = two_materials({0.5, 0.0}, {0.9, 0.0});
    EXPECT_NEAR(drawn_restitution(scene, 0, 0, 1), std::sqrt((3.0 * 0.25 + 1.0 * 0.81) / 4.0), 1e-15);
    EXPECT_EQ(drawn_restitution(scene, 0, wall_body(0), 1), 0.9);
}

TEST(ImpactRestitution, OfAPairOverridesTheMaterials) {
    Scene scene = two_materials({0.5, 0.0}, {0.9, 0.0});
    scene.materials.set_pair(1, 0, 0.25, Restitution{0.1, 0.0});
    EXPECT_EQ(drawn_restitution(scene, 0, 0, 1), 0.1);
    EXPECT_EQ(pair_law(scene, 0, 1).friction, 0.25);
    EXPECT_EQ(pair_law(scene, wall_body(0), 1).friction, 0.25) << "the wall is of the light material";
    EXPECT_NEAR(pair_law(scene, wall_body(0), 0).friction, 0.4, 1e-15);
}

TEST(PairFriction, IsTheGeometricMeanWhereTheTableIsSilent) {
    const Scene scene = two_materials({0.5, 0.0}, {0.9, 0.0});
    EXPECT_NEAR(pair_law(scene, 0, 1).friction, 0.6, 1e-15);  // of 0.4 and 0.9
}

TEST(ImpactRestitution, IsGaussianTruncatedToZeroAndOne) {
    Scene scene = two_materials({0.5, 0.1}, {0.95, 0.2});
    double sum = 0.0;
    double squares = 0.0;
    double largest = 0.0;
    constexpr int n = 20000;
    for (int step = 0; step < n; ++step) {
        const double e = drawn_restitution(scene, step, wall_body(0), 0);
        sum += e;
        squares += (e - 0.5) * (e - 0.5);
        const double near_one = drawn_restitution(scene, step, wall_body(0), 1);
        ASSERT_GE(near_one, 0.0);
        ASSERT_LE(near_one, 1.0);
        largest = std::max(largest, near_one);
    }
    EXPECT_NEAR(sum / n, 0.5, 4 * 0.1 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares / n), 0.1, 0.003);
    EXPECT_GT(largest, 0.999);
}

TEST(ImpactRestitution, DependsOnSeedStepAndPairOnly) {
    Scene scene = two_materials({0.5, 0.1}, {0.5, 0.1});
    const double first = drawn_restitution(scene, 7, 0, 1);
    EXPECT_NE(drawn_restitution(scene, 8, 0, 1), first);
    EXPECT_NE(drawn_restitution(scene, 7, wall_body(0), 1), first);
    EXPECT_EQ(drawn_restitution(scene, 7, 0, 1), first);
    scene.seed = 2;
    EXPECT_NE(drawn_restitution(scene, 7, 0, 1), first);
}

}  // namespace
}  // namespace polargrain
