#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/observe/force_chains.h"
#include "tests/observe/observed.h"

namespace polargrain::testing {
namespace {

using ::testing::ElementsAre;

/// Five by five disks that touch as on a square lattice; the middle column carries 10, all else 0.1.
struct Lattice {
    Scene scene;
    std::vector<Contact> contacts;

    explicit Lattice(double strong) {
        std::vector<Vec2> places;
        for (int k = 0; k < 25; ++k) places.emplace_back(0.02 * (k % 5), 0.02 * (k / 5));
        scene = disks_at(places);
        for (int k = 0; k < 25; ++k) {
            if (k % 5 < 4) contacts.push_back(press(scene, k, k + 1, 0.1));
            if (k < 20) contacts.push_back(press(scene, k, k + 5, k % 5 == 2 ? strong : 0.1));
        }
    }
};

TEST(ForceChains, FindTheLoadedColumnOfALattice) {
    const Lattice lattice(10.0);
    const ForceChains found = find_force_chains(lattice.scene.grains, lattice.contacts);
    ASSERT_EQ(found.chains.size(), 1U);
    EXPECT_THAT(found.chains[0], ElementsAre(2, 7, 12, 17, 22));
    EXPECT_DOUBLE_EQ(found.mean_length(), 5.0);
    EXPECT_NEAR(found.force_share, 40.0 / (40.0 + 36 * 0.1), 1e-12);
}

TEST(ForceChains, NeedThreeGrains) {
    const Scene scene = disks_at({{0.0, 0.0}, {0.0, 0.02}, {1.0, 0.0}, {1.0, 0.02}});
    const ForceChains found =
        find_force_chains(scene.grains, std::vector<Contact>{press(scene, 0, 1, 10.0), press(scene, 2, 3, 1.0)});
    EXPECT_TRUE(found.chains.empty());
    EXPECT_EQ(found.force_share, 0.0);
    EXPECT_TRUE(std::isnan(found.mean_length()));
}

TEST(ForceChains, DoNotGoRoundSharpCorners) {
    // Two columns, each pressed along itself, touch at their feet crosswise to both; weak pairs lie far away.
    std::vector<Vec2> places = {{0.0, 0.0}, {0.0, 0.02}, {0.0, 0.04}, {0.02, 0.0}, {0.02, 0.02}, {0.02, 0.04}};
    for (int k = 0; k < 8; ++k) places.emplace_back(1.0 + 0.02 * k, 0.0);
    const Scene scene = disks_at(places);
    std::vector<Contact> contacts = {press(scene, 0, 1, 10.0), press(scene, 1, 2, 10.0), press(scene, 3, 4, 10.0),
                                     press(scene, 4, 5, 10.0), press(scene, 0, 3, 3.0)};
    for (int k = 6; k < 14; k += 2) contacts.push_back(press(scene, k, k + 1, 0.1));
    const ForceChains found = find_force_chains(scene.grains, contacts);
    ASSERT_EQ(found.chains.size(), 2U);
    EXPECT_THAT(found.chains[0], ElementsAre(0, 1, 2));
    EXPECT_THAT(found.chains[1], ElementsAre(3, 4, 5));
}

TEST(ForceChains, OfNothingAreNone) {
    const Scene scene = disks_at({{0.0, 0.0}});
    EXPECT_TRUE(find_force_chains(scene.grains, {}).chains.empty());
}

}  // namespace
}  // namespace polargrain::testing
