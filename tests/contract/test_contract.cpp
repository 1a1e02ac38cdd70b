// The same laws for every engine. What an engine cannot do by its nature stands in engines.h, as a number.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/contract/engines.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::ContractEngine;
using testing::Running;

constexpr double k_g = 9.81;

class EveryEngine : public ::testing::TestWithParam<ContractEngine> {
protected:
    double dt() const { return GetParam().dt; }
};

TEST_P(EveryEngine, LetsAGrainFlyItsParabola) {
    Scene scene = testing::empty_scene(0.5, 0.3);
    scene.add(Grain{testing::add_star(scene, 0.01, 0.006, 5), 0, {0.1, 1.0}, 0.3, {0.7, 0.4}, 3.0});
    Running sim(GetParam().make, scene);
    sim.run(0.3, dt());
    const Grains& g = sim.world.grains;
    // A step that ends with the speed of its end may lag by half a step of gravity.
    const double slack = GetParam().free_flight + 0.5 * k_g * 0.3 * dt();
    EXPECT_NEAR(g.x[0], 0.1 + 0.21, slack);
    EXPECT_NEAR(g.y[0], 1.0 + 0.12 - 0.5 * k_g * 0.09, slack);
    EXPECT_NEAR(g.vy[0], 0.4 - 0.3 * k_g, 10.0 * GetParam().free_flight);
    EXPECT_NEAR(std::remainder(g.angle[0] - 0.3 - 0.9, 6.283185307179586), 0.0, 10.0 * GetParam().free_flight);
    EXPECT_EQ(sim.world.step, 300);
    EXPECT_EQ(sim.world.time, 300 * dt());
}

TEST_P(EveryEngine, KeepsMomentumWhereNothingActsFromOutside) {
    Scene scene = testing::pour(testing::PourShape::mixed, 40, 3, 0.6, 0.3, 6);
    scene.walls.clear();
    scene.gravity = Vec2::Zero();
    // Everything flies towards the middle.
    Vec2 middle = Vec2::Zero();
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) middle += scene.grains.position(k) / scene.grains.size();
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        scene.grains.set_velocity(k, 5.0 * (middle - scene.grains.position(k)) + scene.grains.velocity(k));
    }
    Running sim(GetParam().make, scene);
    double scale = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        scale += scene.grains.mass[Grains::at(k)] * std::sqrt(scene.grains.velocity(k).squaredNorm());
    }
    const Vec2 before = testing::momentum(sim.world.grains);
    sim.run(0.25, dt());
    EXPECT_GT(sim.impacts, 20);
    EXPECT_LT((testing::momentum(sim.world.grains) - before).norm(), GetParam().free_flight * scale);
}

TEST_P(EveryEngine, ReturnsTheShareOfSpeedThatRestitutionSays) {
    for (const double e : {0.4, 0.8, 1.0}) {
        Scene scene = testing::empty_scene(e, 0.0, 0.0);
        testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
        const ShapeIndex disk = testing::add_disk(scene, 0.01);
        scene.add(Grain{disk, 0, {0.0, 0.05}, 0.0, {0.0, -0.7}});
        scene.add(Grain{disk, 0, {0.5, 0.50}, 0.0, {0.0, 0.5}});
        scene.add(Grain{disk, 0, {0.5, 0.55}, 0.0, {0.0, -0.6}});
        Running sim(GetParam().make, scene);
        sim.run(0.12, dt());
        EXPECT_NEAR(sim.world.grains.vy[0] / 0.7, e, GetParam().restitution);
        EXPECT_NEAR((sim.world.grains.vy[2] - sim.world.grains.vy[1]) / 1.1, e, GetParam().restitution);
    }
}

TEST_P(EveryEngine, CarriesTheWeightOfAGrainAtRest) {
    Scene scene = testing::empty_scene(0.3, 0.3);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.0101}});
    Running sim(GetParam().make, scene);
    sim.run(1.0, dt());
    double force = 0.0;
    const int steps = 200;
    for (int k = 0; k < steps; ++k) {
        sim.step(dt());
        force -= sim.wall_force(0, dt()).y() / steps;
    }
    fmt::print("{}: floor carries {:.5f} of the weight, gap {:.3g} radii\n", GetParam().name, force / sim.weight(),
               sim.world.grains.y[0] / 0.01 - 1.0);
    EXPECT_NEAR(force / sim.weight(), 1.0, 0.01);
    EXPECT_LT(std::abs(sim.world.grains.y[0] / 0.01 - 1.0), GetParam().resting_gap);
}

TEST_P(EveryEngine, StopsABlockAfterTheDistanceThatCoulombSays) {
    Scene scene = testing::empty_scene(0.0, 0.2);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {2.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.04, 0.02), 0, {0.0, 0.01}, 0.0, {0.6, 0.0}});
    Running sim(GetParam().make, scene);
    sim.run(0.6, dt());
    const double exact = 0.36 / (2.0 * 0.2 * k_g);
    fmt::print("{}: slid {:.5f} m, exact {:.5f}\n", GetParam().name, sim.world.grains.x[0], exact);
    if (GetParam().slides) {
        EXPECT_NEAR(sim.world.grains.x[0] / exact, 1.0, GetParam().sliding);
    } else {
        EXPECT_LT(sim.world.grains.x[0] / exact, 0.5);
    }
}

TEST_P(EveryEngine, ClosesItsBooks) {
    Running sim(GetParam().make, testing::pour(testing::PourShape::mixed, 60, 5, 0.5, 0.4, 8));
    sim.run(0.4, dt());
    EXPECT_GT(sim.impacts, 100);
    EXPECT_LT(sim.ledger_error, 1e-10 * sim.start_energy);
    EXPECT_GT(sim.ledger.restitution_loss, 0.0);
    EXPECT_GT(sim.ledger.friction_loss, 0.0);
}

TEST_P(EveryEngine, GoesOnFromACheckpointWithTheSameBits) {
    const Scene scene = testing::pour(testing::PourShape::mixed, 60, 5, 0.5, 0.4, 8);
    const auto whole = GetParam().make(scene);
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < 300; ++k) whole->step(world, dt(), report);
    Checkpoint checkpoint;
    whole->save(checkpoint);
    World copy = world;
    const auto second = GetParam().make(scene);
    second->load(checkpoint);
    for (int k = 0; k < 40; ++k) {
        whole->step(world, dt(), report);
        second->step(copy, dt(), report);
    }
    EXPECT_EQ(state_hash(world), state_hash(copy));
}

TEST_P(EveryEngine, GivesTheSameBitsTwice) {
    const auto run = [this] {
        Running sim(GetParam().make, testing::pour(testing::PourShape::rough, 40, 8, 0.3, 0.4, 6));
        sim.run(0.2, dt());
        return state_hash(sim.world);
    };
    EXPECT_EQ(run(), run());
}

TEST_P(EveryEngine, ReportsContactsInOrderWithTheNormalOutOfTheFirst) {
    Running sim(GetParam().make, testing::pour(testing::PourShape::disk, 60, 2, 0.3, 0.4, 8));
    sim.run(0.5, dt());
    ASSERT_FALSE(sim.report.contacts.empty());
    for (std::size_t k = 0; k < sim.report.contacts.size(); ++k) {
        const Contact& c = sim.report.contacts[k];
        EXPECT_LT(c.a, c.b);
        EXPECT_NEAR(c.normal.squaredNorm(), 1.0, 1e-5);
        if (k > 0) {
            const Contact& before = sim.report.contacts[k - 1];
            EXPECT_TRUE(std::pair(before.a, before.b) <= std::pair(c.a, c.b));
        }
        if (is_wall(c.a)) continue;
        EXPECT_GT(c.normal.dot(sim.world.grains.position(c.b) - sim.world.grains.position(c.a)), 0.0);
    }
}

// A disk that bounces and a bed that comes down: whatever pushed in the step is in the report, over or not.
TEST_P(EveryEngine, ReportsContactsThatAddUpToWhatWallsFelt) {
    Running sim(GetParam().make, testing::pour(testing::PourShape::mixed, 60, 5, 0.5, 0.4, 8));
    double sum_of_forces = 0.0;
    sim.run(0.4, dt(), [&] {
        std::vector<Vec2> on_wall(sim.report.walls.size(), Vec2::Zero());
        for (const Contact& c : sim.report.contacts) {
            if (is_wall(c.a)) on_wall[static_cast<std::size_t>(wall_index(c.a))] -= c.impulse;
        }
        for (std::size_t w = 0; w < on_wall.size(); ++w) {
            const Vec2 felt = sim.report.walls[w].linear;
            sum_of_forces += felt.norm();
            ASSERT_LT((on_wall[w] - felt).norm(), GetParam().free_flight * (1.0 + felt.norm()))
                << "wall " << w << " at step " << sim.world.step;
        }
    });
    EXPECT_GT(sum_of_forces, 0.1 * sim.weight() * 0.4);
}

INSTANTIATE_TEST_SUITE_P(Engines, EveryEngine, ::testing::ValuesIn(testing::k_engines),
                         [](const auto& engine) { return engine.param.name; });

}  // namespace
}  // namespace polargrain
