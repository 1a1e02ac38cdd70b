// Walls that start, push and stop: what every engine makes of them, against closed forms.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/contract/engines.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::ContractEngine;
using testing::Running;

constexpr double k_g = 9.81;

class PushingWall : public ::testing::TestWithParam<ContractEngine> {
protected:
    double dt() const { return GetParam().dt; }
};

Scene disk_on_a_lift(double restitution, const LinearMotion& motion) {
    Scene scene = testing::empty_scene(restitution, 0.3);
    testing::add_wall(scene, "lift", {{-1.0, 0.0}, {1.0, 0.0}}, motion);
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.01}});
    return scene;
}

/// Neither start nor end of the motion is a multiple of the step.
TEST_P(PushingWall, ThatRisesCarriesADiskAndWorksAgainstItsWeight) {
    const double v = 0.3;
    Running sim(GetParam().make, disk_on_a_lift(0.0, {{0.0, v}, 0.1003, std::nullopt}));
    const double mass = sim.scene.grains.mass[0];
    sim.run(0.4, dt());
    const double time = 0.4 - 0.1003;
    const double way = sim.world.grains.y[0] - 0.01;
    // Whatever the force, the wall gives momentum at one speed.
    const double work = mass * v * (v + k_g * time);
    fmt::print("{}: speed {:.5f}, way {:.6f} ({:.6f}), work {:.6f} ({:.6f}) J/m, ledger {:.2g}\n", GetParam().name,
               sim.world.grains.vy[0], way, v * time, sim.ledger.wall_work, work, sim.ledger_error);
    EXPECT_LT(sim.ledger_error, 1e-12);
    if (!GetParam().slides) return;  // what rests on something is not carried on there
    EXPECT_NEAR(sim.world.grains.vy[0] / v, 1.0, 1e-3);
    EXPECT_NEAR(way, v * time, 0.01 * GetParam().resting_gap + 1e-5);
    EXPECT_NEAR(sim.ledger.wall_work / work, 1.0, GetParam().restitution);
}

TEST_P(PushingWall, ThatStopsLetsADiskFlyOn) {
    const double v = 1.0;
    const double start = 0.1003;
    const double end = 0.2508;
    Running sim(GetParam().make, disk_on_a_lift(0.0, {{0.0, v}, start, end}));
    double highest = 0.0;
    double deepest = 0.0;
    sim.run(0.7, dt(), [&] {
        highest = std::max(highest, sim.world.grains.y[0] - 0.01);
        deepest = std::max(deepest, sim.report.deepest);
    });
    const double lift = v * (end - start);
    const double exact = lift + v * v / (2.0 * k_g);
    fmt::print("{}: {:.6f} m high ({:.6f}), at last {:.6f} ({:.6f}), speed {:.2g}, ledger {:.2g}, deepest {:.2g} m\n",
               GetParam().name, highest, exact, sim.world.grains.y[0] - 0.01, lift, sim.world.grains.vy[0],
               sim.ledger_error, deepest);
    EXPECT_LT(sim.ledger_error, 1e-12);
    if (!GetParam().slides) return;
    EXPECT_NEAR(highest, exact, 2.0 * v * dt());
    EXPECT_NEAR(sim.world.grains.y[0] - 0.01, lift, 0.01 * GetParam().resting_gap) << "back on the lift";
    EXPECT_NEAR(sim.world.grains.vy[0], 0.0, 1e-3);
}

TEST_P(PushingWall, ThrowsAnElasticDiskOutAtTwiceItsSpeed) {
    const double v = 0.7;
    Scene scene = testing::empty_scene(1.0, 0.3, 0.0);
    testing::add_wall(scene, "piston", {{0.0, 1.0}, {0.0, -1.0}}, LinearMotion{{v, 0.0}, 0.02, std::nullopt});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.05, 0.0}});
    Running sim(GetParam().make, scene);
    sim.run(0.2, dt());
    const double mass = scene.grains.mass[0];
    fmt::print("{}: leaves at {:.6f} v, work {:.6f} of 2 m v^2\n", GetParam().name, sim.world.grains.vx[0] / v,
               sim.ledger.wall_work / (2.0 * mass * v * v));
    EXPECT_NEAR(sim.world.grains.vx[0] / v, 2.0, GetParam().restitution);
    EXPECT_NEAR(sim.ledger.wall_work / (2.0 * mass * v * v), 1.0, GetParam().restitution);
    EXPECT_LT(sim.ledger_error, 1e-12);
}

TEST_P(PushingWall, PaysForTheFrictionAndTheMotionOfABlock) {
    if (!GetParam().slides) return;  // a block that lasts on a floor is not pushed along there
    const double v = 0.25;
    const double friction = 0.4;
    Scene scene = testing::empty_scene(0.0, friction);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    testing::add_wall(scene, "piston", {{0.0, 0.1}, {0.0, -0.1}}, LinearMotion{{v, 0.0}, 0.0503, std::nullopt});
    scene.walls[1].material = scene.materials.add({"glass", 2000.0, {0.0, 0.0}, 0.0});
    scene.add(Grain{testing::add_rectangle(scene, 0.06, 0.02), 0, {0.04, 0.01}});
    Running sim(GetParam().make, scene);
    const double begin = 0.0503 + 0.01 / v;
    sim.run(0.6, dt());
    const double mass = scene.grains.mass[0];
    const double way = v * (0.6 - begin);
    const double rubbed = friction * mass * k_g * way;
    const double kinetic = 0.5 * mass * v * v;
    fmt::print("{}: speed {:.5f} v, work {:.5f} of {:.5f} J/m, friction {:.5f} of {:.5f}, jolt {:.5f} of {:.5f}\n",
               GetParam().name, sim.world.grains.vx[0] / v, sim.ledger.wall_work, rubbed + 2.0 * kinetic,
               sim.ledger.friction_loss, rubbed, sim.ledger.restitution_loss, kinetic);
    EXPECT_NEAR(sim.world.grains.vx[0] / v, 1.0, 2e-2);
    EXPECT_NEAR(sim.world.grains.angle[0], 0.0, 1e-3);
    EXPECT_NEAR(sim.ledger.wall_work / (rubbed + 2.0 * kinetic), 1.0, GetParam().sliding);
    EXPECT_NEAR(sim.ledger.friction_loss / rubbed, 1.0, GetParam().sliding);
    EXPECT_LT(sim.ledger_error, 1e-10);
}

/// A bed that rests, is pushed together and rests again.
Scene pushed_bed(int threads) {
    Scene scene = testing::pour(testing::PourShape::mixed, 60, 5, 0.3, 0.4, 8);
    scene.threads = threads;
    testing::add_wall(scene, "piston", {{-0.01, 0.8}, {-0.01, -0.1}}, LinearMotion{{0.2, 0.0}, 0.1204, 0.2207});
    return scene;
}

TEST_P(PushingWall, GoesOnFromACheckpointWithTheSameBits) {
    const Scene scene = pushed_bed(1);
    const auto whole = GetParam().make(scene);
    World world = initial_world(scene);
    StepReport report;
    const auto step_to = [&](std::int64_t step) {
        while (world.step < step) whole->step(world, dt(), report);
    };
    // Before and after the start, on the way, before and after the end.
    for (const std::int64_t at : {115, 121, 180, 216, 222}) {
        step_to(at);
        Checkpoint checkpoint;
        whole->save(checkpoint);
        World copy = world;
        const auto second = GetParam().make(scene);
        second->load(checkpoint);
        StepReport resumed;
        for (int k = 0; k < 6; ++k) {
            step_to(world.step + 1);
            second->step(copy, dt(), resumed);
            EXPECT_EQ(report.ledger.wall_work, resumed.ledger.wall_work);
        }
        EXPECT_EQ(state_hash(world), state_hash(copy)) << "from step " << at;
    }
}

TEST_P(PushingWall, GivesTheSameBitsWithTwoThreads) {
    const auto run = [this](int threads) {
        Running sim(GetParam().make, pushed_bed(threads));
        sim.run(0.23, dt());
        EXPECT_GT(sim.ledger.wall_work, 0.0);
        return state_hash(sim.world);
    };
    EXPECT_EQ(run(1), run(2));
}

INSTANTIATE_TEST_SUITE_P(Engines, PushingWall, ::testing::ValuesIn(testing::k_engines),
                         [](const auto& engine) { return engine.param.name; });

}  // namespace
}  // namespace polargrain
