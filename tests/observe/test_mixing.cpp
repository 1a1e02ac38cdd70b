#include <gtest/gtest.h>

#include <cmath>

#include "src/core/random.h"
#include "src/observe/mixing.h"
#include "tests/observe/observed.h"

namespace polargrain::testing {
namespace {

/// n by n disks a centimetre apart.
Scene square(int n) {
    std::vector<Vec2> places;
    for (int k = 0; k < n * n; ++k) places.emplace_back(0.01 * (k % n), 0.01 * (k / n));
    return disks_at(places, 0.004);
}

TEST(LaceyIndex, IsZeroForHalvesApartAndOneAtRandom) {
    constexpr int k_side = 60;
    const Scene scene = square(k_side);
    GrainMask apart(scene.grains.x.size(), 0);
    for (std::size_t k = 0; k < apart.size(); ++k) apart[k] = k % k_side < k_side / 2 ? 1 : 0;
    constexpr double k_cell = 0.05 - 1e-9;  // five grains wide: no cell holds both kinds
    EXPECT_NEAR(lacey_index(scene, scene.grains, apart, k_cell), 0.0, 1e-12);

    RandomStream random(5, RandomPurpose::test);
    double mean = 0.0;
    constexpr int k_draws = 20;
    for (int draw = 0; draw < k_draws; ++draw) {
        GrainMask mixed(apart.size(), 0);
        for (char& marked : mixed) marked = random.uniform() < 0.3 ? 1 : 0;
        mean += lacey_index(scene, scene.grains, mixed, k_cell) / k_draws;
    }
    // S^2 of a binomial draw spreads by sqrt(2 / cells) of SR^2 = S0^2 / 25.
    EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt(2.0 / 144.0) / 24.0 / std::sqrt(k_draws) + 2e-3);
}

TEST(LaceyIndex, LiesBetweenForHalfMixedGrains) {
    // Shares of 0.8 and 0.2 in the halves: variance 0.09 of 0.25, SR^2 = 0.25 / 25 drawn on top.
    constexpr int k_side = 60;
    const Scene scene = square(k_side);
    RandomStream random(6, RandomPurpose::test);
    GrainMask mask(scene.grains.x.size(), 0);
    for (std::size_t k = 0; k < mask.size(); ++k) {
        mask[k] = random.uniform() < (k % k_side < k_side / 2 ? 0.8 : 0.2) ? 1 : 0;
    }
    const double expected = (0.25 - 0.09 - 0.16 / 25.0) / (0.25 * (1.0 - 1.0 / 25.0));
    EXPECT_NEAR(lacey_index(scene, scene.grains, mask, 0.05 - 1e-9), expected, 0.03);
}

TEST(LaceyIndex, IsNoNumberForOneKindOrSingleGrains) {
    const Scene scene = square(4);
    EXPECT_TRUE(std::isnan(lacey_index(scene, scene.grains, all_of(scene), 0.02)));
    GrainMask one(16, 0);
    one[3] = 1;
    EXPECT_TRUE(std::isnan(lacey_index(scene, scene.grains, one, 0.005)));
}

TEST(ShareAndPurity, CountWhatLiesInARegion) {
    const Scene scene = square(4);
    GrainMask mask(16, 0);
    for (const std::size_t k : {0U, 1U, 2U, 15U}) mask[k] = 1;
    const Region lower_row{{-0.001, -0.001}, {0.031, 0.001}};
    EXPECT_DOUBLE_EQ(share_in_region(scene.grains, mask, lower_row), 0.75);
    EXPECT_DOUBLE_EQ(purity(scene.grains, mask, lower_row), 0.75);
    EXPECT_DOUBLE_EQ(purity(scene.grains, mask), 0.25);
    EXPECT_TRUE(std::isnan(purity(scene.grains, mask, Region{{5.0, 5.0}, {6.0, 6.0}})));
    EXPECT_TRUE(std::isnan(share_in_region(scene.grains, GrainMask(16, 0), lower_row)));
}

TEST(HeightRank, IsTheShareOfTheOthersBelow) {
    const Scene scene = disks_at({{0.0, 0.5}, {0.0, 0.1}, {0.0, 0.2}, {0.0, 0.3}, {0.0, 0.9}});
    EXPECT_DOUBLE_EQ(height_rank(scene, scene.grains, {1, 0, 0, 0, 0}), 0.75);
    EXPECT_DOUBLE_EQ(height_rank(scene, scene.grains, {0, 1, 0, 0, 1}), 0.5);
    EXPECT_TRUE(std::isnan(height_rank(scene, scene.grains, all_of(scene))));
}

TEST(KindOfGrains, IsByShapeMaterialOrStart) {
    Scene scene = disks_at({{0.0, 0.0}, {1.0, 0.0}});
    scene.materials.add({"steel", 7800.0, {}, 0.0});
    const ShapeIndex other = scene.add(std::make_shared<const Shape>(Disk("grain#7*1.05", 0.01)));
    scene.add(Grain{other, 1, {2.0, 0.0}});
    EXPECT_EQ(declared_name(scene.shape(other)), "grain");
    ObservableSpec spec;
    EXPECT_EQ(kind_of_grains(scene, spec), (GrainMask{1, 1, 1}));
    spec.shape = "grain";
    EXPECT_EQ(kind_of_grains(scene, spec), (GrainMask{0, 0, 1}));
    spec.shape.reset();
    spec.material = "stone";
    EXPECT_EQ(kind_of_grains(scene, spec), (GrainMask{1, 1, 0}));
    spec.started_in = Region{{0.5, -1.0}, {3.0, 1.0}};
    EXPECT_EQ(kind_of_grains(scene, spec), (GrainMask{0, 1, 0}));
}

}  // namespace
}  // namespace polargrain::testing
