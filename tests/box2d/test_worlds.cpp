#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/core/error.h"
#include "src/engines/box2d/box2d_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::PourShape;
using testing::Running;

TEST(Box2dDeterminism, TwoRunsAgreeToTheLastBit) {
    const Scene scene = testing::pour(PourShape::mixed, 120, 11, 0.5, 0.3, 10);
    Running first(make_box2d, scene);
    Running second(make_box2d, scene);
    first.run(0.5, 1e-3);
    second.run(0.5, 1e-3);
    EXPECT_EQ(state_hash(first.world), state_hash(second.world));
}

/// Steps taken before a run is saved: at, just before, just after and between two rebuildings of Box2D's world.
class Box2dSaved : public ::testing::TestWithParam<int> {};

TEST_P(Box2dSaved, GoesOnBitForBit) {
    const double dt = 1e-3;
    Running whole(make_box2d, testing::pour(PourShape::mixed, 120, 9, 0.5, 0.3, 10));
    whole.run(GetParam() * dt, dt);
    Checkpoint checkpoint;
    whole.engine->save(checkpoint);
    Running resumed(make_box2d, whole.scene);
    resumed.world = whole.world;
    resumed.engine->load(checkpoint);
    Checkpoint again;
    resumed.engine->save(again);
    EXPECT_EQ(again.all_reals(), checkpoint.all_reals());
    EXPECT_EQ(again.all_integers(), checkpoint.all_integers());
    for (int k = 0; k < 150; ++k) {
        whole.step(dt);
        resumed.step(dt);
        ASSERT_EQ(state_hash(whole.world), state_hash(resumed.world)) << k + 1 << " steps after";
        ASSERT_EQ(whole.report.contacts.size(), resumed.report.contacts.size());
        ASSERT_EQ(whole.report.ledger.friction_loss, resumed.report.ledger.friction_loss);
    }
}

INSTANTIATE_TEST_SUITE_P(AfterSteps, Box2dSaved, ::testing::Values(0, 1, 127, 128, 129, 200, 700));

TEST(Box2dCheckpoint, CarriesTheImpulsesIntoARunThatStartsFromRest) {
    const double dt = 1e-3;
    Running settling(make_box2d, testing::pour(PourShape::disk, 60, 5, 0.2, 0.3, 10));
    settling.run(1.0, dt);
    Checkpoint checkpoint;
    settling.engine->save(checkpoint);
    Scene scene = settling.scene;
    scene.grains = settling.world.grains;
    Running warm(make_box2d, scene);
    warm.engine->load(checkpoint);
    Running cold(make_box2d, scene);
    warm.step(dt);
    cold.step(dt);
    const double weight = settling.weight();
    const double of_warm = std::abs(-warm.wall_force(0, dt).y() / weight - 1.0);
    const double of_cold = std::abs(-cold.wall_force(0, dt).y() / weight - 1.0);
    fmt::print("force on the box in the first step differs from the weight by {:.2g}, without impulses by {:.2g}\n",
               of_warm, of_cold);
    EXPECT_LT(of_warm, 0.1);
    EXPECT_GT(of_cold, 2.0 * of_warm);
}

TEST(Box2dRebuilding, IsHardlyToBeSeen) {
    // A resting bed over several rebuildings: the impulses go over, so that nothing jumps.
    Running sim(make_box2d, testing::pour(PourShape::rough, 60, 5, 0.2, 0.5, 10));
    sim.run(1.5, 1e-3);
    const double before = sim.restlessness(0.02);
    double worst = 0.0;
    sim.run(2.0, 1e-3, [&] { worst = std::max(worst, sim.restlessness(0.02)); });
    fmt::print("kinetic energy per grain {:.2g} m g d before, {:.2g} at most over four rebuildings\n", before, worst);
    EXPECT_LT(worst, 1e-4);
}

Scene disk_on(WallMotion motion, double friction, double restitution = 0.0) {
    Scene scene = testing::empty_scene(restitution, friction);
    testing::add_wall(scene, "floor", {{-2.0, 0.0}, {2.0, 0.0}}, std::move(motion));
    scene.add(Grain{testing::add_disk(scene, 0.05), 0, {0.0, 0.0501}, 0.0, {0.0, 0.0}, 0.0});
    return scene;
}

TEST(Box2dWalls, ThatShakeCarryAGrainAndDoItsWork) {
    // Slower than free fall, so that the grain never leaves the floor.
    Running sim(make_box2d, disk_on(SineMotion{Vec2::UnitY(), 0.005, 4.0, 0.0}, 0.0));
    double farthest = 0.0;
    sim.run(0.6, 5e-4, [&] {
        const double floor = wall_state(sim.scene.walls[0], sim.world.time).pose.centre.y();
        if (sim.world.time > 0.1) farthest = std::max(farthest, std::abs(sim.world.grains.y[0] - 0.05 - floor));
    });
    EXPECT_LT(farthest, 2e-4);
    const double lifted = sim.total_energy() - sim.start_energy;
    EXPECT_NEAR(sim.ledger.wall_work - sim.ledger.restitution_loss + sim.ledger.created + sim.ledger.correction -
                    sim.ledger.friction_loss,
                lifted, 1e-9);
    EXPECT_GT(std::abs(sim.ledger.wall_work), 10.0 * std::abs(sim.ledger.created));
}

TEST(Box2dWalls, ThatTurnStayWhereTheyBelong) {
    // A drum of 40 pieces turns for a while; the grain in it must be inside at every moment and be dragged along.
    Scene scene = testing::empty_scene(0.0, 0.8);
    std::vector<Vec2> points;
    for (int k = 0; k <= 40; ++k) {
        const auto [s, c] = sine_cosine(2.0 * k_pi * (k % 40) / 40.0);
        points.emplace_back(0.5 + 0.3 * c, 0.5 + 0.3 * s);
    }
    testing::add_wall(scene, "drum", points, RotationMotion{{0.5, 0.5}, 3.0, 0.0});
    scene.add(Grain{testing::add_disk(scene, 0.05), 0, {0.5, 0.27}, 0.0, {0.0, 0.0}, 0.0});
    Running sim(make_box2d, scene);
    double spin = 0.0;
    sim.run(3.0, 1e-3, [&] {
        ASSERT_LT((sim.world.grains.position(0) - Vec2(0.5, 0.5)).norm(), 0.252);
        if (sim.world.time > 2.0) spin += sim.world.grains.spin[0] / 1000.0;
    });
    // A disk that rolls in place on the turning wall: rim speed 0.3 x 3 over its radius, less what the corners take.
    EXPECT_NEAR(spin / (0.3 * 3.0 / 0.05), 1.0, 0.1);
}

TEST(Box2dWalls, ThatAreRemovedLetGo) {
    Scene scene = disk_on({}, 0.3);
    scene.walls[0].remove_at = 0.2;
    Running sim(make_box2d, scene);
    sim.run(0.2, 1e-3);
    EXPECT_NEAR(sim.world.grains.y[0], 0.05, 1e-3);
    sim.run(0.5, 1e-3);
    EXPECT_NEAR(sim.world.grains.y[0], 0.05 - 0.5 * 9.81 * 0.09, 5e-3);
}

TEST(Box2dWalls, OfPiecesThatBox2dTakesForPointsAreRefused) {
    Scene scene = testing::empty_scene(0.3, 0.3);
    scene.add(Grain{testing::add_disk(scene, 0.05), 0, {0.0, 0.5}});
    testing::add_wall(scene, "ring", {{-1.0, 0.0}, {0.0, 0.0}, {2e-5, 0.0}, {1.0, 0.0}, {0.0, 2.0}, {-1.0, 0.0}});
    try {
        make_box2d(scene, {});
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("wall \"ring\", piece 2"), std::string::npos) << error.what();
    }
}

// There and back along one piece is no ring.
TEST(Box2dWalls, ThatGoThereAndBackHoldAGrain) {
    Scene scene = testing::empty_scene(0.0, 0.3);
    scene.add(Grain{testing::add_disk(scene, 0.05), 0, {0.0, 0.051}});
    testing::add_wall(scene, "plate", {{-1.0, 0.0}, {1.0, 0.0}, {-1.0, 0.0}});
    Running sim(make_box2d, scene);
    sim.run(0.3, 1e-3);
    EXPECT_NEAR(sim.world.grains.y[0], 0.05, 1e-3);
}

TEST(Box2dWalls, EndInCornersThatHoldAGrain) {
    // An opening of 8 cm: a disk of 10 cm rests on its two corners, one of 6 cm falls through.
    const auto scene_with = [](double radius) {
        Scene scene = testing::empty_scene(0.0, 0.5);
        testing::add_wall(scene, "left", {{-0.5, 0.0}, {-0.04, 0.0}});
        testing::add_wall(scene, "right", {{0.04, 0.0}, {0.5, 0.0}});
        scene.add(Grain{testing::add_disk(scene, radius), 0, {0.0, 0.06}, 0.0, {0.0, 0.0}, 0.0});
        return scene;
    };
    Running held(make_box2d, scene_with(0.05));
    held.run(0.5, 1e-3);
    EXPECT_NEAR(held.world.grains.y[0], 0.03, 1e-3);  // 3-4-5
    Running through(make_box2d, scene_with(0.03));
    through.run(0.5, 1e-3);
    EXPECT_LT(through.world.grains.y[0], -0.5);
}

TEST(Box2dFallen, GrainsGoOnFallingFasterThanBox2dAllowsAndCheckpointsKnow) {
    Scene scene = testing::empty_scene(0.0, 0.5);
    testing::add_wall(scene, "sill", {{-0.5, 0.0}, {-0.04, 0.0}});
    scene.add(Grain{testing::add_star(scene, 0.01, 0.006, 5), 0, {0.0, 0.06}, 0.0, {0.0, 0.0}, 2.0});
    const double dt = 1e-3;
    Running whole(make_box2d, scene);
    double fastest_way = 0.0;
    whole.run(1.0, dt);
    Checkpoint checkpoint;
    whole.engine->save(checkpoint);
    Running resumed(make_box2d, scene);
    resumed.world = whole.world;
    resumed.engine->load(checkpoint);
    whole.run(1.5, dt, [&] {
        fastest_way = std::max(fastest_way, -whole.world.grains.vy[0] * dt / box2d_unit(scene, {}));
        resumed.step(dt);
    });
    EXPECT_EQ(state_hash(whole.world), state_hash(resumed.world));
    EXPECT_GT(fastest_way, 2.0);
    EXPECT_NEAR(whole.world.grains.vy[0], -9.81 * 1.5, 1e-3);
    EXPECT_NEAR(whole.world.grains.y[0], 0.06 - 0.5 * 9.81 * 1.5 * (1.5 + dt), 1e-2);
    EXPECT_NEAR(whole.world.grains.angle[0], 3.0, 1e-3);
}

TEST(Box2dPour, OfEveryShapeComesToRestInsideTheBox) {
    for (const PourShape shape : {PourShape::rough, PourShape::star, PourShape::stick, PourShape::mixed}) {
        Running sim(make_box2d, testing::pour(shape, 60, 3, 0.3, 0.4, 10));
        sim.run(1.2, 1e-3);
        EXPECT_LT(sim.restlessness(0.02), 1e-3);
        EXPECT_NEAR(-sim.wall_force(0, 1e-3).y() / sim.weight(), 1.0, 0.1);
        for (GrainIndex k = 0; k < sim.world.grains.size(); ++k) {
            EXPECT_GT(sim.world.grains.y[Grains::at(k)], 0.0);
            EXPECT_LT(sim.world.grains.y[Grains::at(k)], 0.3);
        }
        // Non-convex grains as wholes: what overlaps is no deeper than 0.5 % of a diameter.
        const int overlaps = testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-4);
        EXPECT_EQ(overlaps, 0);
    }
}

}  // namespace
}  // namespace polargrain
