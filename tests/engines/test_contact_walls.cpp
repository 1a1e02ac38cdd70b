#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/core/random.h"
#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::PourShape;
using testing::Running;

constexpr double k_g = 9.81;
constexpr double k_d = 0.02;

/// Peak acceleration of three times gravity at 20 Hz.
SineMotion shaking() {
    const double omega = 2.0 * k_pi * 20.0;
    return {{0.0, 1.0}, 3.0 * k_g / (omega * omega), 20.0, 0.0};
}

class ShakenBox : public ::testing::TestWithParam<PourShape> {};

TEST_P(ShakenBox, AtThreeTimesGravityNothingOverlapsAndTheWorkOfTheWallsClosesTheLedger) {
    const std::uint64_t seed = 5;
    Scene scene = testing::pour(GetParam(), 60, seed, 0.5, 0.3, 10);
    // A quarter of a diameter wider than ten: a full row of disks would have no room for resting gaps, and moves be
    // rejected in one bed of four (docs/refined-engine.md, Promises and limits).
    for (Vec2& p : scene.walls[0].points) {
        if (p.x() > 0.0) p.x() += 0.25 * k_d;
    }
    scene.walls[0].motion = shaking();
    Running sim(make_contact, scene);
    const double dt = sim.engine->suggested_dt();
    int overlaps = 0;
    sim.run(1.0, dt, [&] {
        if (sim.world.step % 20 == 0) {
            overlaps += testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9);
        }
    });
    fmt::print("seed {} dt {:.3g}: overlaps {}, rejected {:.4f} %, wall work {:.4f}, lost {:.4f}, E0 {:.4f}, ", seed,
               dt, overlaps, 100.0 * sim.rejected_share(), sim.ledger.wall_work,
               sim.ledger.restitution_loss + sim.ledger.friction_loss, sim.start_energy);
    fmt::print("rises {:.2g} E0, ledger {:.2g} E0\n", sim.ledger.rises / sim.start_energy,
               sim.ledger_error / sim.start_energy);
    EXPECT_EQ(overlaps, 0);
    EXPECT_LT(sim.rejected_share(), 1e-3);
    EXPECT_LT(sim.ledger_error, 1e-12 * sim.start_energy);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    EXPECT_GT(sim.ledger.wall_work, 0.05 * sim.start_energy) << "a shaken floor feeds the bed";
    EXPECT_GT(sim.restlessness(k_d), 1e-3) << "and keeps it moving";
}

INSTANTIATE_TEST_SUITE_P(Shapes, ShakenBox, ::testing::Values(PourShape::rough, PourShape::disk, PourShape::mixed),
                         [](const auto& c) {
                             return c.param == PourShape::rough  ? "rough"
                                    : c.param == PourShape::disk ? "disk"
                                                                 : "mixed";
                         });

class LiftedByAFloor : public ::testing::TestWithParam<bool> {};

TEST_P(LiftedByAFloor, AGrainIsThrownWhereTheFloorsAccelerationFallsBelowGravity) {
    Scene scene = testing::empty_scene(0.0, 0.3);
    const SineMotion motion{{0.0, 1.0}, 0.01, 10.0, 0.0};
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}}, motion);
    const ShapeIndex shape = GetParam() ? testing::add_rectangle(scene, k_d, k_d) : testing::add_disk(scene, 0.5 * k_d);
    scene.add(Grain{shape, 0, {0.0, 0.5 * k_d}});
    Running sim(make_contact, scene);
    double highest = 0.0;
    double deepest = 0.0;
    double left = 0.0;
    sim.run(0.12, 1e-4, [&] {
        highest = std::max(highest, sim.world.grains.y[0] - 0.5 * k_d);
        for (const Contact& c : sim.report.contacts) deepest = std::min(deepest, c.gap);
        if (left == 0.0 && sim.world.time > 2e-3 && sim.wall_force(0, 1e-4).norm() == 0.0) left = sim.world.time;
    });
    const double omega = 2.0 * k_pi * motion.frequency;
    const double sine = k_g / (motion.amplitude * omega * omega);
    const double speed = motion.amplitude * omega * std::sqrt(1.0 - sine * sine);
    const double exact = motion.amplitude * sine + speed * speed / (2.0 * k_g);
    const double exact_time = std::asin(sine) / omega;
    fmt::print("left after {:.5f} s (exact {:.5f}), {:.5f} m high (exact {:.5f}), deepest overlap {:.2g} m\n", left,
               exact_time, highest, exact, deepest);
    EXPECT_NEAR(left, exact_time, 3e-4);
    EXPECT_NEAR(highest / exact, 1.0, 0.02);
    EXPECT_EQ(deepest, 0.0);
    EXPECT_NEAR(sim.world.grains.angle[0], 0.0, 1e-3) << "a resting gap may open at one corner";
    EXPECT_EQ(sim.moves.rejected, 0);
}

INSTANTIATE_TEST_SUITE_P(DiskAndBox, LiftedByAFloor, ::testing::Bool());

constexpr double k_drum_radius = 0.15;

/// 60 rough grains in a closed drum of 48 flat pieces about the origin, turning counter-clockwise.
Scene drum(double rate, std::uint64_t seed) {
    Scene scene = testing::empty_scene(0.4, 0.5);
    std::vector<Vec2> points;
    for (int k = 0; k < 48; ++k) {
        const double angle = 2.0 * k_pi * k / 48.0;
        points.emplace_back(k_drum_radius * std::cos(angle), k_drum_radius * std::sin(angle));
    }
    points.push_back(points.front());
    testing::add_wall(scene, "drum", points, RotationMotion{Vec2::Zero(), rate, 0.0});
    RandomStream random(seed, RandomPurpose::test);
    for (int k = 0; k < 60; ++k) {
        const int row = k / 8;
        const Vec2 place{(k % 8 - 3.5) * 1.3 * k_d, (row - 3.6) * 1.3 * k_d};
        scene.add(Grain{testing::add_rough(scene, 0.5 * k_d, 0.2, static_cast<std::uint64_t>(k)), 0, place,
                        random.uniform(-k_pi, k_pi)});
    }
    return scene;
}

TEST(Drum, TwoRevolutionsKeepTheGrainsInsideAndTheTorqueBalancesTheirWeight) {
    const std::uint64_t seed = 2;
    const double rate = k_pi;
    Running sim(make_contact, drum(rate, seed));
    ASSERT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, 0.0, 1e-9), 0);
    const double dt = sim.engine->suggested_dt();
    const double weight = sim.weight();
    int overlaps = 0;
    double farthest = 0.0;
    double torque_of_weight = 0.0;  // about the axle, on the grains, over the second revolution
    double torque_of_drum = 0.0;
    double offset = 0.0;
    std::int64_t steps = 0;
    sim.run(4.0, dt, [&] {
        if (sim.world.step % 50 == 0) {
            overlaps += testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9);
        }
        double x = 0.0;
        double mass = 0.0;
        for (GrainIndex k = 0; k < sim.world.grains.size(); ++k) {
            farthest = std::max(farthest, sim.world.grains.position(k).norm());
            x += sim.world.grains.mass[Grains::at(k)] * sim.world.grains.x[Grains::at(k)];
            mass += sim.world.grains.mass[Grains::at(k)];
        }
        if (sim.world.time < 2.0) return;
        offset += x / mass;
        torque_of_weight += -weight * (x / mass) * dt;
        torque_of_drum += -sim.report.walls[0].angular;
        ++steps;
    });
    offset /= static_cast<double>(steps);
    fmt::print("seed {} dt {:.3g}: overlaps {}, farthest centre {:.4f} m of {}, rejected {:.4f} %, rises {:.2g} E0\n",
               seed, dt, overlaps, farthest, k_drum_radius, 100.0 * sim.rejected_share(),
               sim.ledger.rises / std::abs(sim.start_energy));
    fmt::print("bed pushed {:.4f} m to the right; drum {:.5f}, weight {:.5f} N s\n", offset, torque_of_drum,
               torque_of_weight);
    EXPECT_EQ(overlaps, 0);
    EXPECT_LT(farthest, k_drum_radius);
    EXPECT_LT(sim.rejected_share(), 1e-3);
    EXPECT_LT(sim.ledger_error, 1e-12 * weight * k_drum_radius);
    EXPECT_LT(sim.ledger.rises, 1e-9 * weight * k_drum_radius);
    EXPECT_GT(sim.ledger.wall_work, 0.0);
    EXPECT_GT(offset, 0.1 * k_drum_radius) << "the bottom of the drum moves to the right and drags the bed along";
    // Over one revolution the angular momentum of the grains changes by little against the impulses of either torque.
    EXPECT_NEAR(torque_of_drum / -torque_of_weight, 1.0, 0.05);
}

/// Smooth disks of many sizes between smooth walls, on a floor that sinks a grain in a second.
Scene bed_on_a_sinking_floor(std::uint64_t seed) {
    Scene scene = testing::empty_scene(0.2, 0.0);
    const double width = 10.0 * k_d;
    testing::add_wall(scene, "left", {{0.0, 4.0}, {0.0, -1.0}});
    testing::add_wall(scene, "right", {{width, -1.0}, {width, 4.0}});
    testing::add_wall(scene, "floor", {{0.0, 0.0}, {width, 0.0}},
                      SineMotion{{0.0, -1.0}, 10.0 * k_d, 0.1 / (2.0 * k_pi), 0.0});
    RandomStream random(seed, RandomPurpose::test);
    for (int k = 0; k < 200; ++k) {
        const ShapeIndex disk = testing::add_disk(scene, 0.5 * k_d * random.uniform(0.8, 1.2));
        scene.add(Grain{disk,
                        0,
                        {(0.7 + 1.25 * (k % 7)) * k_d, (0.7 + 1.25 * std::floor(k / 7.0)) * k_d},
                        0.0,
                        {0.1 * random.normal(), 0.0}});
    }
    return scene;
}

/// What sweeps leave unbalanced must not hold a bed up: all of its weight is on the floor that it follows.
TEST(SinkingFloor, BearsTheWholeWeightOfASmoothBed) {
    for (const std::uint64_t seed : {1U, 2U}) {
        Running sim(make_contact, bed_on_a_sinking_floor(seed));
        const double dt = 5e-4;
        sim.run(1.0, dt);
        double share = 0.0;
        const int steps = 2000;
        for (int k = 0; k < steps; ++k) {
            sim.step(dt);
            share -= sim.wall_force(2, dt).y() / sim.weight() / steps;
        }
        fmt::print("seed {}: share of the weight {:.5f} (1), created {:.2g} E0, rises {:.2g} E0\n", seed, share,
                   sim.ledger.created / sim.start_energy, sim.ledger.rises / sim.start_energy);
        EXPECT_NEAR(share, 1.0, 2e-3);
        EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    }
}

/// A disk at rest on a floor.
Scene disk_on_a_floor(double restitution, const LinearMotion& motion) {
    Scene scene = testing::empty_scene(restitution, 0.3);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}}, motion);
    scene.add(Grain{testing::add_disk(scene, 0.5 * k_d), 0, {0.0, 0.5 * k_d}});
    return scene;
}

/// Wherever in a step, and in a sub-step, the floor starts and stops.
class FloorThatJumps : public ::testing::TestWithParam<double> {};

constexpr double k_step = 1e-3;

TEST_P(FloorThatJumps, StrikesADiskWithAllOfItsSpeed) {
    const double v = 0.5;
    const double start = (100.0 + GetParam()) * k_step;
    for (const double e : {0.0, 0.6, 1.0}) {
        Running sim(make_contact, disk_on_a_floor(e, {{0.0, v}, start, start + 20.3 * k_step}));
        // The blow falls at the beginning of the sub-step, so that one that does not bounce is a little ahead at first.
        const double until = e > 0.0 ? 0.102 : 0.119;
        sim.run(until, k_step);
        const double mass = sim.scene.grains.mass[0];
        const double since = until - start;
        const double after = (1.0 + e) * v - (e > 0.0 ? k_g * since : 0.0);
        const double work = mass * v * (1.0 + e) * v + (e > 0.0 ? 0.0 : mass * k_g * v * since);
        fmt::print("e {}: {:.5f} m/s (exact {:.5f}), work {:.6f} J/m ({:.6f})\n", e, sim.world.grains.vy[0], after,
                   sim.ledger.wall_work, work);
        EXPECT_NEAR(sim.world.grains.vy[0], after, k_g * k_step / 8.0);
        EXPECT_NEAR(sim.ledger.wall_work / work, 1.0, 2e-3);
        EXPECT_NEAR(sim.ledger.restitution_loss / (0.5 * mass * v * v), 1.0 - e * e, 1e-2);
        EXPECT_EQ(sim.report.deepest, 0.0);
        EXPECT_LT(sim.ledger_error, 1e-14);
    }
}

TEST_P(FloorThatJumps, LetsADiskGoOnAsHighAsItsSpeedTakesItAndComesToRestUnderIt) {
    const double v = 0.6;
    const double start = 100.4 * k_step;
    const double end = (300.0 + GetParam()) * k_step;
    Running sim(make_contact, disk_on_a_floor(0.0, {{0.0, v}, start, end}));
    const double resting = 1e-3 * k_d;
    double highest = 0.0;
    double deepest = 0.0;
    double carried = 0.0;  // largest distance from the floor while it rises
    sim.run(0.8, k_step, [&] {
        const double floor = wall_state(sim.scene.walls[0], sim.world.time).pose.centre.y();
        const double gap = sim.world.grains.y[0] - 0.5 * k_d - floor;
        highest = std::max(highest, sim.world.grains.y[0] - 0.5 * k_d);
        deepest = std::max(deepest, sim.report.deepest);
        if (sim.world.time > 0.2 && sim.world.time < end) carried = std::max(carried, std::abs(gap - resting));
    });
    const double exact = resting + v * (end - start) + v * v / (2.0 * k_g);
    const double mass = sim.scene.grains.mass[0];
    const double work = mass * v * (v + k_g * (end - start));
    fmt::print("{:.7f} m high (exact {:.7f}), at last {:.2g} m from the floor, work {:.6f} J/m ({:.6f})\n", highest,
               exact, sim.world.grains.y[0] - 0.5 * k_d - v * (end - start), sim.ledger.wall_work, work);
    EXPECT_NEAR(highest, exact, 0.13 * v * k_step) << "a sub-step of way";
    EXPECT_LT(carried, 1e-3 * resting);
    EXPECT_EQ(deepest, 0.0);
    EXPECT_NEAR(sim.world.grains.y[0] - 0.5 * k_d - v * (end - start), resting, 5e-2 * resting);
    EXPECT_EQ(sim.world.grains.vy[0], 0.0) << "a floor that has stopped lets rest to the last bit";
    EXPECT_NEAR(-sim.wall_force(0, k_step).y() / sim.weight(), 1.0, 1e-6);
    EXPECT_NEAR(sim.ledger.wall_work / work, 1.0, 1e-3);
    EXPECT_LT(sim.ledger_error, 1e-14);
    EXPECT_LT(sim.ledger.rises, 1e-13);
}

TEST_P(FloorThatJumps, ThatSinksIsCaughtUpWithAndLeavesNoGap) {
    const double v = 0.4;
    const double start = (100.0 + GetParam()) * k_step;
    const double end = (400.0 + GetParam()) * k_step;
    Running sim(make_contact, disk_on_a_floor(0.0, {{0.0, -v}, start, end}));
    double deepest = 0.0;
    const auto look = [&] { deepest = std::max(deepest, sim.report.deepest); };
    // Falls freely until 2 v / g after the start, lands with v relative to the floor, and rides on.
    sim.run(0.18, k_step, look);
    const double fallen = -0.5 * k_g * (0.18 - start) * (0.18 - start);
    EXPECT_NEAR(sim.world.grains.y[0] - (0.5 + 1e-3) * k_d, fallen, 0.13 * k_step * k_g * (0.18 - start));
    sim.run(0.399, k_step, look);
    EXPECT_NEAR(sim.world.grains.vy[0], -v, 1e-6);
    sim.run(0.45, k_step, look);
    EXPECT_NEAR(sim.world.grains.y[0] - 0.5 * k_d + v * (end - start), 1e-3 * k_d, 1e-5 * k_d);
    EXPECT_EQ(sim.world.grains.vy[0], 0.0);
    EXPECT_EQ(deepest, 0.0);
    EXPECT_LT(sim.ledger_error, 1e-14);
}

/// A disk that goes along with a wall, to which that is a jump of the same kind as a start.
TEST_P(FloorThatJumps, StopsADiskThatRidesBehindItWithItsRestitution) {
    const double v = 0.4;
    for (const double e : {0.5, 1.0}) {
        Scene scene = disk_on_a_floor(e, {{0.0, -v}, 0.0, (400.0 + GetParam()) * k_step});
        scene.gravity = Vec2::Zero();
        scene.grains.set_velocity(0, {0.0, -v});
        Running sim(make_contact, std::move(scene));
        double deepest = 0.0;
        sim.run(0.42, k_step, [&] { deepest = std::max(deepest, sim.report.deepest); });
        fmt::print("comes back at {:.6f} v\n", sim.world.grains.vy[0] / v);
        EXPECT_NEAR(sim.world.grains.vy[0] / v, e, 1e-9);
        EXPECT_EQ(sim.ledger.wall_work, 0.0) << "the wall stands when it is hit";
        EXPECT_EQ(deepest, 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(PartsOfAStep, FloorThatJumps, ::testing::Values(0.0, 0.01, 0.0625, 0.3, 0.5, 0.77, 0.99));

/// A bed at rest to the last bit, whose steps are left out, is woken by a piston and left alone by it again.
TEST(Piston, WakesABedAndLetsItComeToRestAgain) {
    const std::uint64_t seed = 4;
    Scene scene = testing::pour(PourShape::rough, 60, seed, 0.3, 0.4, 8);
    const double start = 2.0003;
    const double end = 2.2506;
    testing::add_wall(scene, "piston", {{-0.001, 1.0}, {-0.001, -0.1}}, LinearMotion{{0.1, 0.0}, start, end});
    Running sim(make_contact, scene);
    const double dt = 5e-4;
    const auto middle = [&] {
        double x = 0.0;
        for (const double of_grain : sim.world.grains.x) x += of_grain / sim.world.grains.size();
        return x;
    };
    sim.run(2.0, dt);
    EXPECT_EQ(sim.restlessness(k_d), 0.0);
    const double before = middle();
    const double work_before = sim.ledger.wall_work;
    double deepest = 0.0;
    double restless = 0.0;
    sim.run(end, dt, [&] { restless = std::max(restless, sim.restlessness(k_d)); });
    sim.run(6.0, dt, [&] { deepest = std::max(deepest, sim.report.deepest); });
    fmt::print("seed {}: pushed by {:.4f} m, work {:.4f} J/m, deepest {:.2g} m, rises {:.2g} E0, ledger {:.2g} E0\n",
               seed, middle() - before, sim.ledger.wall_work, deepest, sim.ledger.rises / sim.start_energy,
               sim.ledger_error / sim.start_energy);
    EXPECT_EQ(work_before, 0.0);
    EXPECT_GT(restless, 1e-4);
    EXPECT_GT(middle() - before, 0.005);
    EXPECT_GT(sim.ledger.wall_work, 0.0);
    EXPECT_EQ(sim.restlessness(k_d), 0.0);
    EXPECT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9), 0);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    EXPECT_LT(sim.ledger_error, 1e-12 * sim.start_energy);
}

TEST(Plug, OnceRemovedLetsItsGrainsFallFreely) {
    Scene scene = testing::empty_scene(0.2, 0.2);
    testing::add_wall(scene, "plug", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.walls[0].remove_at = 0.3;
    const ShapeIndex box = testing::add_rectangle(scene, k_d, k_d);
    const ShapeIndex disk = testing::add_disk(scene, 0.5 * k_d);
    scene.add(Grain{box, 0, {0.0, 0.5 * k_d}});
    scene.add(Grain{disk, 0, {0.1, 0.5 * k_d}});
    Running sim(make_contact, scene);
    sim.run(0.3, 1e-3);
    const Grains held = sim.world.grains;
    EXPECT_NEAR(held.y[0], 0.5 * k_d, 2e-3 * k_d);
    EXPECT_NEAR(-sim.wall_force(0, 1e-3).y() / sim.weight(), 1.0, 1e-6);
    sim.run(0.5, 1e-3);
    for (std::size_t k = 0; k < 2; ++k) {
        const double exact = held.y[k] + held.vy[k] * 0.2 - 0.5 * k_g * 0.04;
        fmt::print("fell to {:.9f} m, exact {:.9f}\n", sim.world.grains.y[k], exact);
        EXPECT_NEAR(sim.world.grains.y[k], exact, 1e-9);
        EXPECT_EQ(sim.wall_force(0, 1e-3), Vec2(0.0, 0.0));
    }
}

}  // namespace
}  // namespace polargrain
