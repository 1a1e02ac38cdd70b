#include <gtest/gtest.h>

#include <cmath>

#include "src/core/random.h"
#include "src/observe/structure.h"
#include "tests/observe/observed.h"
#include "tests/support/scenes.h"

namespace polargrain::testing {
namespace {

/// Touching disks on a hexagonal lattice, `n` by `n`.
Scene hexagonal(int n, double radius) {
    std::vector<Vec2> places;
    for (int row = 0; row < n; ++row) {
        for (int k = 0; k < n; ++k) {
            places.emplace_back(2.0 * radius * k + radius * (row % 2), std::sqrt(3.0) * radius * row);
        }
    }
    return disks_at(places, radius);
}

std::vector<Contact> touching_pairs(const Scene& scene, double radius) {
    std::vector<Contact> contacts;
    for (GrainIndex a = 0; a < scene.grains.size(); ++a) {
        for (GrainIndex b = a + 1; b < scene.grains.size(); ++b) {
            const Vec2 way = scene.grains.position(b) - scene.grains.position(a);
            if (way.squaredNorm() < 4.01 * radius * radius) contacts.push_back(press(scene, a, b, 1.0));
        }
    }
    return contacts;
}

TEST(CoordinationNumber, OfAHexagonalPackingIsSixInside) {
    const Scene scene = hexagonal(12, 0.01);
    const std::vector<Contact> contacts = touching_pairs(scene, 0.01);
    EXPECT_DOUBLE_EQ(coordination_number(scene.grains, contacts, Region{{0.04, 0.03}, {0.18, 0.15}}), 6.0);
    EXPECT_DOUBLE_EQ(coordination_number(scene.grains, contacts),
                     2.0 * static_cast<double>(contacts.size()) / scene.grains.size());
}

TEST(CoordinationNumber, CountsAPartnerOnceAndWallsToo) {
    const Scene scene = disks_at({{0.0, 0.01}, {0.02, 0.01}});
    const std::vector<Contact> contacts = {press(scene, 0, 1, 1.0), press(scene, 0, 1, 2.0),
                                           press(scene, 0, 0, Vec2(0.0, 0.0), 1.0)};
    EXPECT_DOUBLE_EQ(coordination_number(scene.grains, contacts), 1.5);
}

TEST(FabricTensor, OfAHexagonalPackingIsIsotropicAndOfARowIsNot) {
    const Scene scene = hexagonal(30, 0.01);
    const auto fabric = fabric_tensor(touching_pairs(scene, 0.01), Region{{0.1, 0.1}, {0.5, 0.4}});
    ASSERT_TRUE(fabric);
    EXPECT_NEAR(fabric->trace(), 1.0, 1e-12);
    EXPECT_LT(2.0 * fabric->deviator(), 0.1);  // whole and half neighbourhoods at the region's edge
    const Scene row = disks_at({{0.0, 0.0}, {0.01, 0.0173}, {0.02, 0.0346}});
    const auto line = fabric_tensor(std::vector<Contact>{press(row, 0, 1, 1.0), press(row, 1, 2, 1.0)});
    EXPECT_NEAR(line->deviator(), 1.0, 1e-12);
    EXPECT_NEAR(line->direction(), std::atan2(0.0173, 0.01), 1e-12);
    EXPECT_FALSE(fabric_tensor({}));
}

TEST(FabricTensor, RecoversTheAnisotropyOfADistribution) {
    // Directions drawn from (1 + a cos 2 (t - 0.3)) / 2 pi by rejection.
    constexpr double k_anisotropy = 0.4;
    RandomStream random(11, RandomPurpose::test);
    std::vector<Contact> contacts;
    while (contacts.size() < 40000) {
        const double t = random.uniform(0.0, 2.0 * k_pi);
        if (random.uniform() * (1.0 + k_anisotropy) > 1.0 + k_anisotropy * std::cos(2.0 * (t - 0.3))) continue;
        contacts.push_back({0, 1, Vec2::Zero(), {std::cos(t), std::sin(t)}, 0.0, Vec2::Zero()});
    }
    const auto fabric = fabric_tensor(contacts);
    EXPECT_NEAR(2.0 * fabric->deviator(), k_anisotropy, 0.02);
    EXPECT_NEAR(fabric->direction(), 0.3, 0.03);
}

TEST(LongAxis, IsThatOfTheAreaAndOnlyOfElongatedShapes) {
    Scene scene = empty_scene(0.0, 0.0);
    const auto upright = long_axis(scene.shape(add_rectangle(scene, 1.0, 3.0)));
    ASSERT_TRUE(upright);
    EXPECT_NEAR(std::abs(*upright), 0.5 * k_pi, 1e-12);
    EXPECT_NEAR(*long_axis(scene.shape(add_stick(scene, 5.0, 1.0))), 0.0, 1e-9);
    EXPECT_FALSE(long_axis(scene.shape(add_disk(scene, 1.0))));
    EXPECT_FALSE(long_axis(scene.shape(add_star(scene, 1.0, 0.5, 5))));
}

Scene sticks(int n) {
    Scene scene = empty_scene(0.0, 0.0);
    const ShapeIndex stick = add_stick(scene, 0.05, 0.01);
    for (int k = 0; k < n; ++k) scene.add(Grain{stick, 0, {0.1 * k, 0.0}});
    return scene;
}

TEST(OrientationOrder, IsOneForParallelSticksAlongTheirDirection) {
    Scene scene = sticks(5);
    for (std::size_t k = 0; k < 5; ++k) scene.grains.angle[k] = 0.4 + k_pi * static_cast<double>(k);
    const auto axes = orientation_order(scene, scene.grains, all_of(scene));
    ASSERT_TRUE(axes);
    EXPECT_NEAR(axes->order, 1.0, 1e-12);
    EXPECT_NEAR(axes->direction, 0.4, 1e-9);
    EXPECT_EQ(axes->grains, 5);
}

TEST(OrientationOrder, VanishesForEvenlySpreadSticksAndLikeOneOverRootNForRandomOnes) {
    Scene even = sticks(60);
    for (std::size_t k = 0; k < 60; ++k) even.grains.angle[k] = k_pi / 60.0 * static_cast<double>(k);
    EXPECT_NEAR(orientation_order(even, even.grains, all_of(even))->order, 0.0, 1e-12);

    constexpr int k_sticks = 4000;
    Scene scene = sticks(k_sticks);
    RandomStream random(3, RandomPurpose::test);
    double squares = 0.0;
    constexpr int k_draws = 50;
    for (int draw = 0; draw < k_draws; ++draw) {
        for (double& angle : scene.grains.angle) angle = random.uniform(0.0, 2.0 * k_pi);
        const double order = orientation_order(scene, scene.grains, all_of(scene))->order;
        squares += order * order / k_draws;
    }
    // <S^2> = 1 / n for independent axes; its own spread over the draws is 1 / (n sqrt(draws)).
    EXPECT_NEAR(squares * k_sticks, 1.0, 4.0 / std::sqrt(k_draws));
}

TEST(OrientationOrder, OfGrainsWithoutALongAxisIsNone) {
    const Scene scene = disks_at({{0.0, 0.0}});
    EXPECT_FALSE(orientation_order(scene, scene.grains, all_of(scene)));
}

}  // namespace
}  // namespace polargrain::testing
