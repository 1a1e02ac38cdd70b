#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/core/error.h"
#include "src/observe/bridges.h"
#include "tests/observe/observed.h"

namespace polargrain::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Five disks in an arch over an opening 0.08 wide, the ends on the two floors, and one grain that lies on top.
struct Arch {
    Scene scene = disks_at({{-0.044, 0.01},
                            {-0.0285, 0.0226},
                            {-0.01, 0.03},
                            {0.01, 0.03},
                            {0.0285, 0.0226},
                            {0.044, 0.01},
                            {0.0, 0.047}});
    std::vector<Contact> contacts;
    Opening opening{{-0.04, 0.0}, {0.04, 0.0}};

    Arch() {
        scene.walls.push_back({"left", 0, {{-0.2, 0.0}, {-0.04, 0.0}}, {}, std::nullopt});
        scene.walls.push_back({"right", 0, {{0.04, 0.0}, {0.2, 0.0}}, {}, std::nullopt});
        contacts.push_back(press(scene, 0, 0, Vec2(-0.044, 0.0), 1.0));
        contacts.push_back(press(scene, 1, 5, Vec2(0.044, 0.0), 1.0));
        for (int k = 0; k < 5; ++k) contacts.push_back(press(scene, k, k + 1, 1.0));
        contacts.push_back(press(scene, 2, 6, 0.1));
        contacts.push_back(press(scene, 3, 6, 0.1));
    }
};

TEST(Bridge, IsTheArchFromOneSideToTheOther) {
    const Arch arch;
    EXPECT_THAT(find_bridge(arch.scene, arch.scene.grains, arch.contacts, arch.opening), ElementsAre(0, 1, 2, 3, 4, 5));
    const Opening other_way{arch.opening.to, arch.opening.from};
    EXPECT_EQ(find_bridge(arch.scene, arch.scene.grains, arch.contacts, other_way).size(), 6U);
}

TEST(Bridge, IsNoneWhereAGrainFallsOrAContactIsMissing) {
    Arch arch;
    std::vector<Contact> parted = arch.contacts;
    parted.erase(parted.begin() + 4);  // between 2 and 3; grain 6 still joins them
    EXPECT_EQ(find_bridge(arch.scene, arch.scene.grains, parted, arch.opening).size(), 7U);
    parted.pop_back();
    EXPECT_THAT(find_bridge(arch.scene, arch.scene.grains, parted, arch.opening), IsEmpty());
    arch.scene.grains.set_velocity(3, {0.0, -0.2});
    EXPECT_THAT(find_bridge(arch.scene, arch.scene.grains, arch.contacts, arch.opening), ElementsAre());
}

TEST(Bridge, IsNoneOverGrainsThatLieBelowOrFarAway) {
    Arch arch;
    EXPECT_THAT(find_bridge(arch.scene, arch.scene.grains, arch.contacts, {{-0.04, 0.5}, {0.04, 0.5}}), IsEmpty());
    EXPECT_THAT(find_bridge(arch.scene, arch.scene.grains, arch.contacts, {{-0.04, -0.5}, {0.04, -0.5}}), IsEmpty());
}

TEST(Bridge, NeedsGravity) {
    Arch arch;
    arch.scene.gravity = Vec2::Zero();
    EXPECT_THROW(find_bridge(arch.scene, arch.scene.grains, arch.contacts, arch.opening), InputError);
    EXPECT_THROW(BridgeMeter(arch.scene, arch.opening, BridgeMeter::Measure::count), InputError);
}

/// Stands from 0.1 to 0.4 s with a flicker, is gone, and stands again from 0.8 s on.
bool stands(double time) { return (time >= 0.1 && time < 0.4 && !(time > 0.2 && time < 0.21)) || time >= 0.8; }

TEST(BridgeMeter, CountsLivesAndForgivesAFlicker) {
    const Arch arch;
    BridgeMeter meter(arch.scene, arch.opening, BridgeMeter::Measure::life);
    StepReport with, without;
    with.contacts = arch.contacts;
    World world = initial_world(arch.scene);
    const Totals totals;
    constexpr double k_dt = 1e-3;
    for (world.step = 1; world.step <= 1000; ++world.step) {
        world.time = static_cast<double>(world.step) * k_dt;
        meter.step(world, k_dt, stands(world.time) ? with : without);
    }
    const std::vector<double> lives = meter.lives();
    ASSERT_EQ(lives.size(), 2U);
    EXPECT_NEAR(lives[0], 0.3, 2.0 * k_dt);
    EXPECT_NEAR(lives[1], 0.2, 2.0 * k_dt);
    EXPECT_NEAR(meter.read({arch.scene, world, with, totals}), 0.25, 2.0 * k_dt);

    Checkpoint saved;
    meter.save(saved, "here");
    BridgeMeter again(arch.scene, arch.opening, BridgeMeter::Measure::count);
    again.load(saved, "here");
    EXPECT_EQ(again.lives(), lives);
}

TEST(BridgeMeter, PassesOverWhatLivesShorterThanAGrainFalls) {
    const Arch arch;
    BridgeMeter meter(arch.scene, arch.opening, BridgeMeter::Measure::count);
    StepReport with, without;
    with.contacts = arch.contacts;
    World world = initial_world(arch.scene);
    for (world.step = 1; world.step <= 300; ++world.step) {
        world.time = static_cast<double>(world.step) * 1e-3;
        meter.step(world, 1e-3, world.step > 100 && world.step < 130 ? with : without);  // sqrt(d/g) is 45 ms
    }
    EXPECT_TRUE(meter.lives().empty());
}

}  // namespace
}  // namespace polargrain::testing
