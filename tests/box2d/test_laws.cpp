#include <box2d/box2d.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/engines/box2d/box2d_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::PourShape;
using testing::Running;

constexpr double k_single = 1e-6;  ///< what single precision leaves of a number near 1

TEST(Box2dFreeFall, IsThatOfSymplecticEulerInSinglePrecision) {
    Scene scene = testing::empty_scene(0.5, 0.2);
    scene.add(Grain{testing::add_star(scene, 0.02, 0.008, 5), 0, {0.1, 3.0}, 0.2, {0.4, 1.0}, 5.0});
    Running sim(make_box2d, scene);
    const double dt = 1e-3;
    sim.run(0.5, dt);
    // Box2D moves by the new velocity: g dt t / 2 lower than the parabola.
    EXPECT_NEAR(sim.world.grains.x[0], 0.1 + 0.4 * 0.5, 1e-4);
    EXPECT_NEAR(sim.world.grains.y[0], 3.0 + 0.5 - 0.5 * 9.81 * 0.25 - 0.5 * 9.81 * dt * 0.5, 2e-4);
    EXPECT_NEAR(sim.world.grains.vy[0], 1.0 - 9.81 * 0.5, 5e-5);
    EXPECT_NEAR(sim.world.grains.angle[0], 0.2 + 2.5, 1e-4);
    EXPECT_NEAR(sim.world.grains.spin[0], 5.0, 5.0 * k_single);
}

/// Mixed shapes that fly at one another without gravity. Angular momentum with our moments of inertia is kept only by
/// an engine that has them.
Scene imploding_gas(double restitution) {
    Scene scene = testing::pour(PourShape::mixed, 100, 7, restitution, 0.4, 10);
    scene.walls.clear();
    scene.gravity = Vec2::Zero();
    const Vec2 middle{0.1, 0.12};
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const Vec2 r = scene.grains.position(k) - middle;
        scene.grains.set_velocity(k, scene.grains.velocity(k) - 3.0 * r + cross(2.0, r));
    }
    return scene;
}

TEST(Box2dGas, KeepsMomentumAndAngularMomentumOfOurMassesAndInertias) {
    Running sim(make_box2d, imploding_gas(0.7));
    const Vec2 momentum = testing::momentum(sim.world.grains);
    const double angular = testing::angular_momentum(sim.world.grains);
    double total_mass = 0.0;
    for (const double m : sim.world.grains.mass) total_mass += m;
    sim.run(0.4, 5e-4);
    const Vec2 lost = testing::momentum(sim.world.grains) - momentum;
    const double turned = testing::angular_momentum(sim.world.grains) - angular;
    fmt::print("{} impulses: momentum changed by {:.2g} m/s of the mean grain, angular momentum by {:.2g} (relative)\n",
               sim.impacts, lost.norm() / total_mass, turned / angular);
    EXPECT_GT(sim.impacts, 300);
    EXPECT_LT(lost.norm(), 1e-5 * total_mass);
    EXPECT_LT(std::abs(turned), 1e-3 * std::abs(angular));
}

TEST(Box2dLedger, ExplainsWhereTheEnergyOfAGasGoes) {
    Running sim(make_box2d, imploding_gas(0.5));
    sim.run(0.4, 5e-4);
    const double lost = sim.start_energy - sim.total_energy();
    fmt::print("lost {:.4g}: restitution {:.4g}, friction {:.4g}, created {:.2g}\n", lost, sim.ledger.restitution_loss,
               sim.ledger.friction_loss, sim.ledger.created);
    EXPECT_GT(sim.ledger.restitution_loss, 0.1 * lost);
    EXPECT_GT(sim.ledger.friction_loss, 0.01 * lost);
    // What remains is rounding: the two losses are computed from impulses, not as a difference of energies.
    EXPECT_LT(std::abs(sim.ledger.created), 1e-3 * lost);
    EXPECT_LT(sim.ledger_error, 1e-12);
}

/// A square of 10 cm let go a little above a floor.
Scene square_on_floor(double restitution, double friction, double drop = 1e-3) {
    Scene scene = testing::empty_scene(restitution, friction);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.1, 0.1), 0, {0.0, 0.05 + drop}, 0.0, {0.0, 0.0}, 0.0});
    return scene;
}

class Box2dSkin : public ::testing::TestWithParam<double> {};

TEST_P(Box2dSkin, DecidesTheGapAtRest) {
    Box2dSettings settings;
    settings.skin = GetParam();
    // Let go in the floor, because what is not pushed out stays anywhere within the slop.
    const Scene scene = square_on_floor(0.0, 0.3, -5e-4);
    const auto engine = make_box2d(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < 1000; ++k) engine->step(world, 1e-3, report);
    const double predicted = box2d_resting_gap(scene, settings);
    fmt::print("skin {} units: rests {:.3g} m above the floor, predicted {:.3g}\n", GetParam(),
               world.grains.y[0] - 0.05, predicted);
    EXPECT_NEAR(world.grains.y[0] - 0.05, predicted, 0.1 * b2_linearSlop * box2d_unit(scene, settings));
    EXPECT_NEAR(world.grains.angle[0], 0.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(InUnits, Box2dSkin, ::testing::Values(0.0, 0.0025, 0.01));

TEST(Box2dWeight, IsTheForceOnTheFloor) {
    Running sim(make_box2d, square_on_floor(0.0, 0.3));
    sim.run(0.5, 1e-3);
    const Vec2 force = sim.wall_force(0, 1e-3);
    EXPECT_NEAR(-force.y() / sim.weight(), 1.0, 1e-4);
    EXPECT_NEAR(force.x() / sim.weight(), 0.0, 1e-4);
    ASSERT_EQ(sim.report.contacts.size(), 2U);
    for (const Contact& contact : sim.report.contacts) {
        EXPECT_EQ(contact.a, wall_body(0));
        EXPECT_EQ(contact.b, 0);
        EXPECT_NEAR(contact.normal.y(), 1.0, 1e-6);
        EXPECT_NEAR(std::abs(contact.point.x()), 0.05, 1e-3);
    }
}

/// Distance that the square slides down an incline in a second.
double slide(double friction, double degrees) {
    Scene scene = square_on_floor(0.0, friction, 0.0);
    const auto [sine, cosine] = sine_cosine(degrees * k_radians_per_degree);
    scene.gravity = 9.81 * Vec2(sine, -cosine);
    scene.walls[0].points = {{-1.0, 0.0}, {20.0, 0.0}};
    Running sim(make_box2d, scene);
    sim.run(1.0, 1e-3);
    return sim.world.grains.x[0];
}

TEST(Box2dFriction, SticksBelowItsAngleAndSlidesByCoulombAbove) {
    const double mu = 0.5;  // holds up to 26.57 degrees
    EXPECT_NEAR(slide(mu, 26.0), 0.0, 1e-3);
    const auto [sine, cosine] = sine_cosine(30.0 * k_radians_per_degree);
    EXPECT_NEAR(slide(mu, 30.0) / (0.5 * 9.81 * (sine - mu * cosine)), 1.0, 0.01);
    EXPECT_GT(slide(mu, 27.0), 5e-3);
}

/// Speed with which a disk leaves a floor over that with which it comes.
double bounce(const Scene& scene, double speed, const Box2dSettings& settings) {
    const auto engine = make_box2d(scene, settings);
    World world = initial_world(scene);
    world.grains.vy[0] = -speed;
    StepReport report;
    while (world.grains.vy[0] < 0.0 && world.step < 2000) engine->step(world, 1e-3, report);
    return world.grains.vy[0] / speed;
}

Scene disk_over_floor(double restitution) {
    Scene scene = testing::empty_scene(restitution, 0.0, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, 0.05), 0, {0.0, 0.06}, 0.0, {0.0, 0.0}, 0.0});
    return scene;
}

TEST(Box2dRestitution, IsOurs) {
    for (const double e : {0.0, 0.3, 0.85, 1.0}) {
        EXPECT_NEAR(bounce(disk_over_floor(e), 1.0, {}), e, 1e-4);
        // The pair's own, if it has one.
        Scene scene = disk_over_floor(e);
        scene.materials.set_pair(0, 0, {}, Restitution{0.6, 0.0});
        EXPECT_NEAR(bounce(scene, 1.0, {}), 0.6, 1e-4);
    }
}

TEST(Box2dRestitution, EndsAtTheThreshold) {
    Box2dSettings settings;
    settings.restitution_threshold = 0.2;
    EXPECT_NEAR(bounce(disk_over_floor(0.8), 0.21, settings), 0.8, 1e-4);
    EXPECT_NEAR(bounce(disk_over_floor(0.8), 0.19, settings), 0.0, 1e-4);
}

TEST(Box2dUnit, MakesTheLargestGrainFourToEightUnitsAcross) {
    for (const double radius : {1e-4, 0.01, 0.02, 0.0399, 0.5, 3.0}) {
        Scene scene = testing::empty_scene(0.5, 0.5);
        scene.add(Grain{testing::add_disk(scene, radius), 0, {0.0, 0.0}, 0.0, {0.0, 0.0}, 0.0});
        const double units = 2.0 * radius / box2d_unit(scene, {});
        EXPECT_GT(units, 4.0) << radius;
        EXPECT_LE(units, 8.0) << radius;
    }
}

TEST(Box2dSpeedLimit, IsToldWithTheStepToUse) {
    Scene scene = disk_over_floor(0.5);
    scene.grains.vy[0] = -2.0;
    Running sim(make_box2d, scene);
    // 0.1 m across: units of 1/64 m; at 2 m/s a step of 16 ms is two of them.
    EXPECT_DOUBLE_EQ(sim.engine->suggested_dt(), std::min(critical_time_step(scene), 1.0 / 128.0));
    try {
        sim.step(0.016);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("use run.time_step = 0.0078"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(sim.step(0.007));
    // A grain that gets faster than the scene let expect.
    sim.world.grains.vy[0] = 4.6;
    EXPECT_THROW(sim.step(0.007), RunError);
}

TEST(Box2dNotes, TellWhatIsLeftOut) {
    Scene scene = disk_over_floor(0.5);
    EXPECT_EQ(make_box2d(scene)->notes().size(), 3U);
    scene.materials.add({"clay", 1000.0, {0.5, 0.1}, 0.3});
    const auto notes = make_box2d(scene)->notes();
    ASSERT_EQ(notes.size(), 4U);
    EXPECT_NE(notes.back().find("\"clay\""), std::string::npos) << notes.back();
}

}  // namespace
}  // namespace polargrain
