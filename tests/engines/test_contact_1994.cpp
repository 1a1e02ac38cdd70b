#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/motion_update.h"
#include "src/engines/contact/trial_check.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::PourShape;

struct Running {
    const Scene scene;
    std::unique_ptr<Engine> engine;
    World world;
    StepReport report;

    explicit Running(Scene s) : scene(std::move(s)), engine(make_contact_1994(scene)), world(initial_world(scene)) {}

    void step(double dt) { engine->step(world, dt, report); }
    template <typename EachStep>
    void run(double duration, double dt, EachStep each) {
        for (std::int64_t k = 0; static_cast<double>(k) * dt < duration; ++k) {
            step(dt);
            each();
        }
    }
};

// --- the guarantee ---

class NoOverlap : public ::testing::TestWithParam<PourShape> {};

TEST_P(NoOverlap, BeforeMeansNoneAfterInALongPour) {
    Running sim(testing::pour(GetParam(), 160, 3, 0.3, 0.2, 10));
    ASSERT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, 0.0, 1e-9), 0);
    const double dt = sim.engine->suggested_dt();
    std::int64_t impacts = 0;
    sim.run(1.2, dt, [&] {
        impacts += sim.report.impacts;
        if (sim.world.step % 40 != 0) return;
        ASSERT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9), 0)
            << "step " << sim.world.step;
    });
    EXPECT_GT(impacts, 1000);
}

std::string shape_name(const ::testing::TestParamInfo<PourShape>& shape) {
    switch (shape.param) {
        case PourShape::rough: return "rough";
        case PourShape::disk: return "disk";
        case PourShape::star: return "star";
        case PourShape::stick: return "stick";
        case PourShape::mixed: return "mixed";
    }
    return "unknown";
}

INSTANTIATE_TEST_SUITE_P(Shapes, NoOverlap,
                         ::testing::Values(PourShape::rough, PourShape::disk, PourShape::star, PourShape::stick,
                                           PourShape::mixed),
                         shape_name);

/// Checks the next step's trial configuration; grains: the present state, whose velocities get gravity's kick.
TrialConfiguration check_trial(TrialCheck& check, const Running& sim, Grains& grains, double dt,
                               std::vector<RecordedContact>& contacts) {
    TrialConfiguration configuration;
    take_trial(grains, sim.scene.gravity, dt, configuration);
    check.run(configuration, grains, sim.world.time, sim.world.time + dt, contacts);
    return configuration;
}

TEST(Contact1994, EveryRejectedGrainIsInARecordedContact) {
    Running sim(testing::pour(PourShape::rough, 100, 4, 0.3, 0.2, 10));
    const double dt = sim.engine->suggested_dt();
    TrialCheck check(sim.scene);
    MotionUpdate update;
    sim.run(0.5, dt, [&] {
        if (sim.world.step % 10 != 0) return;
        Grains grains = sim.world.grains;
        std::vector<RecordedContact> contacts;
        const TrialConfiguration configuration = check_trial(check, sim, grains, dt, contacts);
        const auto& rejected = update.decide(check.overlaps());
        check.record(configuration, grains, rejected, contacts);
        std::vector<char> in_contact(rejected.size(), 0);
        for (const RecordedContact& c : contacts) {
            if (!is_wall(c.a)) in_contact[Grains::at(c.a)] = 1;
            in_contact[Grains::at(c.b)] = 1;
        }
        for (std::size_t k = 0; k < rejected.size(); ++k) ASSERT_TRUE(!rejected[k] || in_contact[k]) << "grain " << k;
    });
}

TEST(ReachCount, EqualsWarshallOnRealBeds) {
    Running sim(testing::pour(PourShape::rough, 150, 5, 0.3, 0.2, 10));
    const double dt = sim.engine->suggested_dt();
    TrialCheck check(sim.scene);
    std::size_t largest = 0;
    sim.run(0.6, dt, [&] {
        if (sim.world.step % 25 != 0) return;
        Grains grains = sim.world.grains;
        std::vector<RecordedContact> contacts;
        check_trial(check, sim, grains, dt, contacts);
        const auto& order = check.overlaps().order;
        const WarshallClosure closure(grains.size(), order);
        ReachCount reach;
        reach.build(grains.size(), order);
        for (GrainIndex k = 0; k < grains.size(); ++k) ASSERT_EQ(reach.dependants(k), closure.dependants(k));
        largest = std::max(largest, order.size());
    });
    EXPECT_GT(largest, 50U) << "the bed must have depended on itself";
}

// --- conservation ---

TEST(Contact1994, EnergyLedgerClosesEveryStep) {
    Running sim(testing::pour(PourShape::mixed, 80, 6, 0.6, 0.3, 8));
    const double dt = sim.engine->suggested_dt();
    double scale = std::abs(energy(sim.world.grains, sim.scene.gravity).total());
    double before = energy(sim.world.grains, sim.scene.gravity).total();
    sim.run(0.8, dt, [&] {
        const double after = energy(sim.world.grains, sim.scene.gravity).total();
        const EnergyLedger& l = sim.report.ledger;
        ASSERT_NEAR(after - before, l.wall_work + l.created - l.restitution_loss - l.friction_loss, 1e-12 * scale);
        before = after;
    });
}

TEST(Contact1994, EnergyLedgerClosesOnAShakenFloor) {
    Scene scene = testing::empty_scene(0.6, 0.3);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}}, SineMotion{{0.0, 1.0}, 2e-3, 20.0, 0.0});
    const ShapeIndex disk = testing::add_disk(scene, 0.01);
    for (int k = 0; k < 5; ++k) scene.add(Grain{disk, 0, {0.05 * k, 0.0105 + 0.01 * k}});
    Running sim(scene);
    double work = 0.0;
    double before = energy(sim.world.grains, scene.gravity).total();
    sim.run(1.0, sim.engine->suggested_dt(), [&] {
        const double after = energy(sim.world.grains, scene.gravity).total();
        const EnergyLedger& l = sim.report.ledger;
        ASSERT_NEAR(after - before, l.wall_work + l.created - l.restitution_loss - l.friction_loss, 1e-12);
        work += std::abs(l.wall_work);
        before = after;
    });
    EXPECT_GT(work, 0.1);
}

TEST(Contact1994, MomentumIsKeptWithoutWallsAndGravity) {
    Scene scene = testing::pour(PourShape::mixed, 60, 7, 0.5, 0.4, 8);
    scene.walls.clear();
    scene.gravity = Vec2::Zero();
    const Vec2 middle{0.08, 0.1};
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        scene.grains.set_velocity(k, (middle - scene.grains.position(k)) * 3.0);
    }
    Running sim(scene);
    const Vec2 before = testing::momentum(sim.world.grains);
    std::int64_t impacts = 0;
    sim.run(0.5, 5e-4, [&] { impacts += sim.report.impacts; });
    EXPECT_GT(impacts, 100);
    EXPECT_NEAR((testing::momentum(sim.world.grains) - before).norm(), 0.0,
                1e-12 * sim.world.grains.mass[0] * 60 * 3.0);
}

// --- single bodies ---

TEST(Contact1994, FreeFallIsExact) {
    Scene scene = testing::empty_scene(0.5, 0.2);
    const ShapeIndex star = testing::add_star(scene, 0.02, 0.008, 5);
    scene.add(Grain{star, 0, {0.1, 3.0}, 0.2, {0.4, 1.0}, 5.0});
    Running sim(scene);
    sim.run(0.5 - 1e-9, 1e-3, [] {});
    EXPECT_NEAR(sim.world.grains.x[0], 0.1 + 0.4 * 0.5, 1e-12);
    EXPECT_NEAR(sim.world.grains.y[0], 3.0 + 0.5 - 0.5 * 9.81 * 0.25, 1e-12);
    EXPECT_NEAR(sim.world.grains.vy[0], 1.0 - 9.81 * 0.5, 1e-12);
    EXPECT_NEAR(sim.world.grains.angle[0], 0.2 + 2.5, 1e-12);
}

/// Time at which a ball dropped from h has come to rest on the floor.
double bouncing_time(double dt) {
    Scene scene = testing::empty_scene(0.8, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    const double radius = 0.01;
    scene.add(Grain{testing::add_disk(scene, radius), 0, {0.0, 1.0 + radius}});
    Running sim(scene);
    double last_bounce = 0.0;
    sim.run(6.0, dt, [&] {
        if (sim.report.impacts > 0 && sim.world.grains.vy[0] > 0.05) last_bounce = sim.world.time;
    });
    return last_bounce;
}

TEST(Contact1994, BouncingBallComesToRestInTheZenoTime) {
    // sqrt(2 h / g) (1 + e) / (1 - e), less what the bounces slower than 0.05 m/s would still have taken. Each bounce
    // wastes up to a step, so the time converges with dt.
    const double total = std::sqrt(2.0 / 9.81) * 1.8 / 0.2;
    EXPECT_NEAR(total, 4.063713, 1e-6);
    EXPECT_NEAR(bouncing_time(2e-5), total, 0.05);
}

TEST(Contact1994, HeadOnImpactOfThreeBallsIsTheCradle) {
    const double e = 0.9;
    Scene scene = testing::empty_scene(e, 0.0, 0.0);
    const ShapeIndex disk = testing::add_disk(scene, 0.01);
    scene.add(Grain{disk, 0, {0.0, 0.0}, 0.0, {1.0, 0.0}});
    scene.add(Grain{disk, 0, {0.03, 0.0}});
    scene.add(Grain{disk, 0, {0.0502, 0.0}});
    Running sim(scene);
    // The first pass is over when the last ball has been struck; the first has not caught the second by then.
    sim.run(0.012, 1e-5, [] {});
    const double q = 0.5 * (1.0 + e);
    EXPECT_NEAR(sim.world.grains.vx[0], 1.0 - q, 1e-12);
    EXPECT_NEAR(sim.world.grains.vx[1], q * (1.0 - q), 1e-12);
    EXPECT_NEAR(sim.world.grains.vx[2], q * q, 1e-12);
}

class RestitutionInOut : public ::testing::TestWithParam<double> {};

TEST_P(RestitutionInOut, OfTwoDisksAndOfADiskOnAWall) {
    const double e = GetParam();
    Scene scene = testing::empty_scene(e, 0.3, 0.0);
    const ShapeIndex disk = testing::add_disk(scene, 0.01);
    testing::add_wall(scene, "wall", {{1.0, 1.0}, {1.0, -1.0}});
    scene.add(Grain{disk, 0, {0.0, 0.0}, 0.0, {1.0, 0.0}});
    scene.add(Grain{disk, 0, {0.05, 0.0}, 0.0, {-1.0, 0.0}});
    scene.add(Grain{disk, 0, {0.9, 0.5}, 0.0, {2.0, 0.0}});
    Running sim(scene);
    sim.run(0.1, 1e-4, [] {});
    EXPECT_NEAR(sim.world.grains.vx[1] - sim.world.grains.vx[0], 2.0 * e, 1e-12);
    EXPECT_NEAR(sim.world.grains.vx[2], -2.0 * e, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Coefficients, RestitutionInOut, ::testing::Values(0.0, 0.3, 0.6, 0.9, 1.0));

// --- what the literal model does where it fails: measured, so that nobody is surprised ---

TEST(Contact1994, ABlockAtRestFreezesEvenOnAFrictionlessIncline) {
    // A lasting contact sags g dt^2 / 2 into its support in every trial and is rejected: it should slide at
    // g sin(30 deg) = 4.9 m/s^2.
    Scene scene = testing::empty_scene(0.5, 0.0);
    scene.gravity = 9.81 * Vec2(0.5, -std::sqrt(0.75));
    testing::add_wall(scene, "plane", {{-1.0, 0.0}, {3.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.04, 0.02), 0, {0.0, 0.01}});
    Running sim(scene);
    MoveCount moves;
    sim.run(0.5, 1e-3, [&] { moves += sim.report.moves; });
    EXPECT_LT(sim.world.grains.x[0], 0.02) << "exact: 0.613 m";
    EXPECT_GT(moves.rejected, moves.tried * 9 / 10);
}

TEST(Contact1994, ASettledBedRejectsNearlyAllMovesAndCreatesEnergy) {
    Running sim(testing::pour(PourShape::disk, 200, 8, 0.8, 0.0, 12));
    MoveCount late;
    double rises = 0.0;
    sim.run(1.2, 1e-3, [&] {
        rises += sim.report.ledger.rises;
        if (sim.world.time > 1.0) late += sim.report.moves;
    });
    EXPECT_GT(static_cast<double>(late.rejected) / static_cast<double>(late.tried), 0.5);
    EXPECT_GT(rises, 0.0);
}

// --- moving walls ---

TEST(Contact1994, AGrainLeavesWithTheFloorThatLiftsIt) {
    Scene scene = testing::empty_scene(0.0, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}}, SineMotion{{0.0, 1.0}, 0.01, 10.0, 0.0});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.01}});
    Running sim(scene);
    double highest = 0.0;
    sim.run(0.2, 1e-4, [&] { highest = std::max(highest, sim.world.grains.y[0]); });
    // Thrown where the floor's acceleration falls below -g: sin = g / (A omega^2); then free flight.
    const double omega = 2.0 * k_pi * 10.0;
    const double sine = 9.81 / (0.01 * omega * omega);
    const double speed = 0.01 * omega * std::sqrt(1.0 - sine * sine);
    EXPECT_NEAR(highest, 0.01 + 0.01 * sine + speed * speed / (2.0 * 9.81), 5e-4);
}

TEST(Contact1994, ABlockOnARisingFloorLagsBehindIt) {
    // One contact vertex a pair: the block is struck at one corner, turns, is struck at the other, and the floor has
    // gone on meanwhile. The paper knows of such overlaps with moving floors; no step makes them vanish.
    Scene scene = testing::empty_scene(0.0, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}}, SineMotion{{0.0, 1.0}, 0.01, 10.0, 0.0});
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.0, 0.01}});
    Running sim(scene);
    double deepest = 0.0;
    sim.run(0.02, 1e-4, [&] {
        for (const Contact& c : sim.report.contacts) deepest = std::max(deepest, -c.gap);
    });
    EXPECT_GT(deepest, 1e-3);
    EXPECT_LT(deepest, 5e-3);
}

TEST(Contact1994, ARockingBlockFreezesWhereItWasLetGo) {
    // Exact: upright after 0.2208 s. The corner it turns about is a lasting contact, so every trial is rejected.
    Scene scene = testing::empty_scene(0.0, 3.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    const double diagonal = 0.5 * std::hypot(0.1, 0.4);
    const double tilt = 0.5 * std::atan2(0.1, 0.4);
    scene.add(Grain{testing::add_rectangle(scene, 0.1, 0.4),
                    0,
                    {-diagonal * std::sin(tilt), diagonal * std::cos(tilt) + 1e-9},
                    -tilt});
    Running sim(scene);
    MoveCount moves;
    sim.run(0.6, 1e-4, [&] { moves += sim.report.moves; });
    EXPECT_LT(std::abs(sim.world.grains.angle[0] + tilt), 0.1 * tilt);
    EXPECT_GT(moves.rejected, moves.tried * 9 / 10);
}

TEST(Contact1994, ARemovedFloorLetsGo) {
    Scene scene = testing::empty_scene(0.2, 0.2);
    testing::add_wall(scene, "plug", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.walls[0].remove_at = 0.3;
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.0, 0.0101}});
    Running sim(scene);
    sim.run(0.3, 1e-3, [] {});
    EXPECT_NEAR(sim.world.grains.y[0], 0.01, 2e-4);
    const double start = sim.world.grains.y[0];
    const double speed = sim.world.grains.vy[0];
    sim.run(0.2 - 1e-9, 1e-3, [] {});
    EXPECT_NEAR(sim.world.grains.y[0], start + speed * 0.2 - 0.5 * 9.81 * 0.04, 1e-3);
}

TEST(Contact1994, ADiskThatStrikesAFlatTopBesideACornerReboundsFromTheTop) {
    for (const double inboard : {1e-4, 2e-3, 9e-3}) {
        Scene scene = testing::empty_scene(1.0, 0.0, 0.0);
        scene.add(Grain{testing::add_rectangle(scene, 0.2, 0.1), 0, {-0.1, -0.05}});
        const Vec2 struck(-inboard, 0.01);
        const Vec2 velocity(-0.5, -1.0);
        scene.add(Grain{testing::add_disk(scene, 0.01), 0, struck - 0.00535 * velocity, 0.0, velocity});
        Running sim(scene);
        sim.run(0.02, 1e-3, [] {});
        EXPECT_NEAR(sim.world.grains.vx[1], -0.5, 1e-12) << inboard;
        EXPECT_GT(sim.world.grains.vy[1], 0.5) << inboard;
    }
}

// --- reproducibility ---

TEST(Contact1994, SavedAndLoadedItGoesOnBitForBit) {
    Running whole(testing::pour(PourShape::mixed, 80, 9, 0.5, 0.3, 8));
    const double dt = whole.engine->suggested_dt();
    whole.run(0.3, dt, [] {});
    Checkpoint checkpoint;
    whole.engine->save(checkpoint);
    Running resumed(whole.scene);
    resumed.world = whole.world;
    resumed.engine->load(checkpoint);
    whole.run(0.2, dt, [] {});
    resumed.run(0.2, dt, [] {});
    EXPECT_EQ(state_hash(whole.world), state_hash(resumed.world));
}

TEST(Contact1994, MirroredSceneGivesTheMirroredRun) {
    // Disks only, and few: chaos would amplify the round-off of mirrored sums within a second.
    Scene scene = testing::pour(PourShape::rough, 12, 10, 0.5, 0.3, 5);
    Running sim(scene);
    Running reflected(testing::mirrored(scene));
    sim.run(0.12, 5e-4, [] {});
    reflected.run(0.12, 5e-4, [] {});
    for (std::size_t k = 0; k < 12; ++k) {
        EXPECT_NEAR(sim.world.grains.x[k], -reflected.world.grains.x[k], 1e-9);
        EXPECT_NEAR(sim.world.grains.y[k], reflected.world.grains.y[k], 1e-9);
        EXPECT_NEAR(sim.world.grains.angle[k], -reflected.world.grains.angle[k], 1e-7);
    }
}

}  // namespace
}  // namespace polargrain
