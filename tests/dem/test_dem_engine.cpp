#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/core/error.h"
#include "src/core/random.h"
#include "tests/dem/dem_runs.h"

namespace polargrain {
namespace {

using testing::Running;

std::string hash_after(const Scene& scene, const DemSettings& settings, int steps) {
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < steps; ++k) engine->step(world, 1e-3, report);
    return state_hash(world);
}

TEST(PairSearchOfTheEngine, ChangesNoBit) {
    for (const auto shape : {testing::PourShape::disk, testing::PourShape::rough}) {
        const Scene scene = testing::pour(shape, 40, 4, 0.4, 0.4, 6);
        DemSettings settings;
        const std::string expected = hash_after(scene, settings, 180);
        for (const auto search : {PairSearch::direct, PairSearch::nbs, PairSearch::cgrid}) {
            settings.search = search;
            EXPECT_EQ(hash_after(scene, settings, 180), expected);
        }
        settings.search = PairSearch::verlet;
        settings.skin = 0.5;
        EXPECT_EQ(hash_after(scene, settings, 180), expected);
    }
}

TEST(Threads, ChangeNoBit) {
    for (const auto shape : {testing::PourShape::disk, testing::PourShape::rough}) {
        // Touching rows, so that there are contacts from the start and enough of them for several threads.
        Scene scene = testing::pour(shape, 400, 4, 0.4, 0.4, 20);
        for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
            scene.grains.set_position(k, 0.85 * scene.grains.position(k));
        }
        scene.threads = 1;
        const std::string one = hash_after(scene, {}, 4);
        for (const int threads : {2, 5}) {
            scene.threads = threads;
            EXPECT_EQ(hash_after(scene, {}, 4), one) << threads << " threads";
        }
    }
}

/// Energy that the scheme has made while a few grains fall into a box, over the kinetic energy at hand.
double energy_made(double resolution, testing::PourShape shape) {
    Scene scene = testing::pour(shape, 12, 7, 0.9, 0.3, 4);
    DemSettings settings;
    settings.resolution = resolution;
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    EnergyLedger ledger;
    double turned_over = 0.0;
    for (int k = 0; k < 120; ++k) {
        engine->step(world, 1e-3, report);
        ledger += report.ledger;
        turned_over = std::fmax(turned_over, energy(world.grains, scene.gravity).kinetic());
    }
    EXPECT_GT(ledger.restitution_loss, 0.05 * turned_over);
    return ledger.created / turned_over;
}

TEST(Books, OfACollapseCloseToAMillionthAtTheDefaultStep) {
    for (const auto shape : {testing::PourShape::disk, testing::PourShape::rough}) {
        const double coarse = energy_made(10.0, shape);
        const double usual = energy_made(DemSettings{}.resolution, shape);
        fmt::print("made by the scheme over the kinetic energy: {:.2g} at 10 steps a contact, {:.2g} at 25\n", coarse,
                   usual);
        EXPECT_LT(std::abs(coarse), 1e-4);
        EXPECT_LT(std::abs(usual), 1e-6);
    }
}

/// Where in a step a contact begins and ends is chance; none of it may show.
TEST(ElasticImpact, GivesAllEnergyBackWhereverInAStepItBeginsAndEnds) {
    double worst = 0.0;
    for (int k = 0; k < 40; ++k) {
        Scene scene = testing::empty_scene(1.0, 0.0, 0.0);
        testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
        const ShapeIndex disk = testing::add_disk(scene, 0.01);
        scene.add(Grain{disk, 0, {0.0, 0.0101 + 1.3e-6 * k}, 0.0, {0.3, -1.0}});
        scene.add(Grain{disk, 0, {0.5, 0.5}, 0.0, {0.6, 0.2}});
        scene.add(Grain{disk, 0, {0.5205 + 1.7e-6 * k, 0.503}, 0.0, {-0.4, 0.0}});
        Running sim(testing::make_default_dem, scene);
        Vec2 momentum = Vec2::Zero();
        for (const GrainIndex g : {1, 2}) momentum += scene.grains.mass[Grains::at(g)] * scene.grains.velocity(g);
        sim.run(0.02, 1e-3);
        for (const GrainIndex g : {1, 2}) {
            momentum -= sim.world.grains.mass[Grains::at(g)] * sim.world.grains.velocity(g);
        }
        ASSERT_GE(sim.impacts, 2);
        ASSERT_TRUE(sim.report.contacts.empty());
        EXPECT_LT(std::sqrt(momentum.squaredNorm()), 1e-13);
        worst = std::fmax(worst, std::abs(sim.total_energy() / sim.start_energy - 1.0));
    }
    fmt::print("largest relative change of energy {:.2g}\n", worst);
    EXPECT_LT(worst, 1e-7);
}

TEST(EnergyMade, StaysBelowAMillionthAtEveryMomentOfACollapse) {
    Running sim(testing::make_default_dem, testing::pour(testing::PourShape::disk, 40, 3, 0.8, 0.3, 6));
    double worst = 0.0;
    sim.run(0.4, 1e-3, [&] { worst = std::fmax(worst, std::abs(sim.ledger.created)); });
    fmt::print("at most {:.2g} of the initial energy, rises {:.2g}\n", worst / sim.start_energy,
               sim.ledger.rises / sim.start_energy);
    EXPECT_LT(worst, 1e-6 * sim.start_energy);
    EXPECT_LT(sim.ledger.rises, 1e-6 * sim.start_energy);
    EXPECT_GT(sim.ledger.restitution_loss, 0.1 * sim.start_energy);
    EXPECT_GT(sim.ledger.friction_loss, 0.05 * sim.start_energy);
}

TEST(Books, OfAnElasticImpactCloseToAMillionth) {
    Scene scene = testing::empty_scene(1.0, 0.5);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.03}, 0.0, {0.3, 0.0}, 10.0});
    scene.add(Grain{testing::add_star(scene, 0.01, 0.007, 5), 0, {0.1, 0.03}, 0.2, {-0.1, 0.0}, 4.0});
    const auto engine = make_dem(scene, {});
    World world = initial_world(scene);
    StepReport report;
    EnergyLedger ledger;
    for (int k = 0; k < 90; ++k) {
        engine->step(world, 1e-3, report);
        ledger += report.ledger;
    }
    const double at_hand = energy(scene.grains, scene.gravity).total();
    fmt::print("made {:.2g} of the energy; slipped {:.2g}\n", ledger.created / at_hand, ledger.friction_loss / at_hand);
    EXPECT_LT(std::abs(ledger.created), 1e-6 * at_hand);
    EXPECT_GT(ledger.friction_loss, 1e-3 * at_hand);
}

TEST(Checkpoint, KeepsTheMemoryOfEveryLawAndScheme) {
    const Scene scene = testing::pour(testing::PourShape::disk, 30, 4, 0.5, 0.5, 5);
    for (const auto integrator : {SoftIntegrator::velocity_verlet, SoftIntegrator::position_verlet,
                                  SoftIntegrator::gear4, SoftIntegrator::symplectic_euler, SoftIntegrator::taylor}) {
        for (const auto tangential : {TangentialLaw::spring, TangentialLaw::walton_braun, TangentialLaw::slider}) {
            DemSettings settings;
            settings.integrator = integrator;
            settings.law.normal = NormalLaw::walton_braun;
            settings.law.tangential = tangential;
            const auto whole = make_dem(scene, settings);
            World world = initial_world(scene);
            StepReport report;
            for (int k = 0; k < 200; ++k) whole->step(world, 1e-3, report);
            ASSERT_FALSE(report.contacts.empty());
            Checkpoint checkpoint;
            whole->save(checkpoint);
            World copy = world;
            const auto second = make_dem(scene, settings);
            second->load(checkpoint);
            for (int k = 0; k < 20; ++k) {
                whole->step(world, 1e-3, report);
                second->step(copy, 1e-3, report);
            }
            EXPECT_EQ(state_hash(world), state_hash(copy));
        }
    }
}

// Of faces the moment of the dashpot is kept too: the first part of a step books it before it is found anew.
TEST(Checkpoint, KeepsWhatTheBooksNeedOfFaces) {
    const Scene scene = testing::pour(testing::PourShape::stick, 30, 4, 0.2, 0.5, 5);
    const auto whole = make_dem(scene, {});
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < 200; ++k) whole->step(world, 1e-3, report);
    Checkpoint checkpoint;
    whole->save(checkpoint);
    World copy = world;
    const auto second = make_dem(scene, {});
    second->load(checkpoint);
    StepReport report_of_second;
    whole->step(world, 1e-3, report);
    second->step(copy, 1e-3, report_of_second);
    EXPECT_EQ(state_hash(world), state_hash(copy));
    EXPECT_GT(report.ledger.restitution_loss, 0.0);
    EXPECT_EQ(report_of_second.ledger.restitution_loss, report.ledger.restitution_loss);
    EXPECT_EQ(report_of_second.ledger.created, report.ledger.created);
    for (std::size_t w = 0; w < report.walls.size(); ++w)
        EXPECT_EQ(report_of_second.walls[w].angular, report.walls[w].angular);
}

/// A square of 0.1 m falls by 1 mm on a table that ends, with so much of its width beyond the end.
struct Overhang {
    bool side;  ///< the table has a side downwards from its end
    double share;
};

class WallEnd : public ::testing::TestWithParam<Overhang> {};

TEST_P(WallEnd, GivesNothingToASquareThatFallsOffIt) {
    Scene scene = testing::empty_scene(0.5, 0.3);
    std::vector<Vec2> table{{-1.0, 0.0}, {0.0, 0.0}};
    if (GetParam().side) table.emplace_back(0.0, -1.0);
    testing::add_wall(scene, "table", table);
    const double width = 0.1;
    scene.add(
        Grain{testing::add_rectangle(scene, width, width), 0, {(GetParam().share - 0.5) * width, 0.5 * width + 1e-3}});
    Running sim(testing::make_default_dem, scene);
    const double unit = scene.grains.mass[0] * 9.81 * width;
    double made = 0.0;
    for (int k = 0; k < 400; ++k) {
        sim.step(1e-3);
        made = std::max(made, std::abs(sim.ledger.created));
    }
    fmt::print("made {:.2g} m g d on the way\n", made / unit);
    EXPECT_LT(made, 1e-6 * unit);
    EXPECT_LT(sim.world.grains.y[0], -width) << "it has fallen off";
}

INSTANTIATE_TEST_SUITE_P(Overhangs, WallEnd,
                         ::testing::Values(Overhang{false, 0.5}, Overhang{false, 0.6}, Overhang{false, 0.8},
                                           Overhang{true, 0.5}, Overhang{true, 0.6}, Overhang{true, 0.8}),
                         [](const auto& c) {
                             return fmt::format("{:.0f}_percent_beyond_{}", 100.0 * c.param.share,
                                                c.param.side ? "a_corner" : "an_end");
                         });

TEST(MovingWall, DoesTheWorkThatTheBooksSay) {
    Scene scene = testing::pour(testing::PourShape::rough, 20, 4, 0.5, 0.5, 5);
    scene.walls[0].motion = SineMotion{Vec2::UnitY(), 1e-3, 40.0, 0.0};
    Running sim(testing::make_default_dem, scene);
    sim.run(0.5, 1e-3);
    fmt::print("wall work {:.3g}, made by the scheme {:.2g} J/m\n", sim.ledger.wall_work, sim.ledger.created);
    EXPECT_GT(sim.ledger.wall_work, 0.0);
    EXPECT_LT(std::abs(sim.ledger.created), 2e-3 * sim.ledger.wall_work);
    EXPECT_LT(sim.ledger_error, 1e-12 * sim.start_energy);
}

/// A disk on the spring between it and a lift: as the force hardly changes within a step of the scheme, the lift's work
/// grows evenly with the time at which it stops, and not by steps.
TEST(MovingWall, WorksOnAllOfItsWayWhereItStopsWithinAStep) {
    const double v = 2e-3;  // so slow that its way in a step hardly changes the force
    const double dt = 1e-3;
    std::vector<double> work;
    double unit = 0.0;  // the work against the weight in a step
    for (int k = 0; k <= 20; ++k) {
        Scene scene = testing::empty_scene(1.0, 0.0);
        testing::add_wall(scene, "lift", {{-1.0, 0.0}, {1.0, 0.0}});
        scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.01}, 0.0, {0.0, v}});
        scene.walls[0].motion = LinearMotion{{0.0, v}, 0.0, 1.0};
        const double h = dt / testing::make_default_dem(scene)->parts_of_step(dt);
        scene.walls[0].motion = LinearMotion{{0.0, v}, 0.0, 0.3 + (25.0 + 0.1 * k) * h};
        Running sim(testing::make_default_dem, scene);
        sim.run(0.31, dt);
        work.push_back(sim.ledger.wall_work);
        unit = sim.weight() * v * h;
        EXPECT_LT(sim.ledger_error, 1e-14);
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < work.size(); ++k) {
        const double even = work.front() + (work.back() - work.front()) * static_cast<double>(k) / 20.0;
        worst = std::max(worst, std::abs(work[k] - even) / unit);
    }
    fmt::print("{:.3g} in two steps, uneven by {:.2g} (of the work against the weight in a step)\n",
               (work.back() - work.front()) / unit, worst);
    EXPECT_LT(worst, 0.05);
}

TEST(MovingWall, DoesTheSameWorkAfterAResumption) {
    Scene scene = testing::empty_scene(0.4, 0.3);
    testing::add_wall(scene, "table", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.walls[0].motion = SineMotion{Vec2::UnitY(), 1e-3, 5.0, 0.0};
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.01}});
    const auto whole = make_dem(scene, {});
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < 150; ++k) whole->step(world, 1e-3, report);
    ASSERT_FALSE(report.contacts.empty());
    Checkpoint checkpoint;
    whole->save(checkpoint);
    World copy = world;
    const auto second = make_dem(scene, {});
    second->load(checkpoint);
    StepReport resumed;
    whole->step(world, 1e-3, report);
    second->step(copy, 1e-3, resumed);
    EXPECT_NE(report.ledger.wall_work, 0.0);
    EXPECT_EQ(report.ledger.wall_work, resumed.ledger.wall_work);
}

TEST(RemovedWall, LetsGo) {
    Scene scene = testing::empty_scene(0.3, 0.3);
    testing::add_wall(scene, "gate", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.walls[0].remove_at = 0.2;
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.0, 0.01}});
    Running sim(testing::make_default_dem, scene);
    sim.run(0.2, 1e-3);
    EXPECT_NEAR(sim.world.grains.y[0], 0.01, 1e-4);
    sim.run(0.4, 1e-3);
    EXPECT_NEAR(sim.world.grains.y[0], 0.01 - 0.5 * 9.81 * 0.04, 1e-3);
    EXPECT_LT(sim.ledger_error, 1e-12);
}

/// The faces of a right angle know nothing of one another where there is no friction.
TEST(DiskInACorner, ReboundsFromEachFaceAsFromThatFaceAlone) {
    for (const double late : {-8e-4, -4e-4, 4e-4, 8e-4}) {
        Scene scene = testing::empty_scene(0.5, 0.0, 0.0);
        testing::add_box(scene, 0.5, 0.5);
        scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.011 + late, 0.011}, 0.0, {-1.0, -1.0}});
        DemSettings settings;
        settings.law.normal = NormalLaw::walton_braun;
        settings.resolution = 400.0;
        const auto engine = make_dem(scene, settings);
        World world = initial_world(scene);
        StepReport report;
        for (int k = 0; k < 10; ++k) engine->step(world, 1e-3, report);
        ASSERT_TRUE(report.contacts.empty());
        EXPECT_NEAR(world.grains.vx[0], 0.5, 1e-5);
        EXPECT_NEAR(world.grains.vy[0], 0.5, 1e-5);
    }
}

TEST(Notes, WarnOfFacesThatStiffenWithoutLimit) {
    const Scene scene = testing::pour(testing::PourShape::rough, 4, 1, 0.5, 0.5, 2);
    DemSettings settings;
    const std::size_t usual = make_dem(scene, settings)->notes().size();
    settings.area_exponent = 1.5;
    EXPECT_EQ(make_dem(scene, settings)->notes().size(), usual + 1);
    settings.polygons = PolygonContact::potential;
    EXPECT_EQ(make_dem(scene, settings)->notes().size(), usual);
}

TEST(Laws, ForDisksAreRefusedWherePolygonsAre) {
    Scene scene = testing::empty_scene(0.3, 0.3);
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.0, 0.01}});
    DemSettings settings;
    settings.law.normal = NormalLaw::hertz;
    EXPECT_THROW(make_dem(scene, settings), InputError);
}

/// Kinetic energy per mass [m^2/s^2] of 153 beads of 3 mm that run into a hopper: the largest, with steps of 0.5 ms,
/// where two beads collide within 0.84 ms.
double hopper(SoftIntegrator integrator) {
    Scene scene = testing::empty_scene(0.7, 0.0);
    const double radius = 1.5e-3;
    testing::add_wall(scene, "hopper", {{-0.05, 0.08}, {-0.006, 0.0}, {0.006, 0.0}, {0.05, 0.08}});
    const ShapeIndex bead = testing::add_disk(scene, radius);
    RandomStream random(4, RandomPurpose::test);
    const double pitch = 2.05 * radius;
    for (int row = 0, n = 0; n < 153; ++row) {
        const double y = 0.003 + row * pitch;
        const double half = 0.006 + 0.55 * y - 1.3 * radius;
        for (int k = 0; k <= static_cast<int>(2.0 * half / pitch) && n < 153; ++k, ++n) {
            scene.add(Grain{bead, 0, {-half + k * pitch + random.uniform(0.0, 1e-5), y}});
        }
    }
    DemSettings settings;
    settings.integrator = integrator;
    settings.resolution = 1.0;
    settings.law.stiffness = scene.grains.mass[0] * std::pow(3.14159265358979 / 1.186e-3, 2);
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    double largest = 0.0;
    for (int k = 0; k < 400; ++k) {
        engine->step(world, 5e-4, report);
        const double mass = 153.0 * scene.grains.mass[0];
        largest = std::fmax(largest, energy(world.grains, scene.gravity).kinetic() / mass);
    }
    EXPECT_EQ(engine->parts_of_step(5e-4), 1.0);
    return largest;
}

TEST(Hopper, BlowsUpExplicitlyAtAStepAtWhichTheImplicitSchemeFlows) {
    const double fall = 9.81 * 0.08;
    const double verlet = hopper(SoftIntegrator::velocity_verlet);
    const double numerov = hopper(SoftIntegrator::numerov_central);
    fmt::print("largest kinetic energy over that of the full fall: velocity Verlet {:.3g}, Numerov {:.3g}\n",
               verlet / fall, numerov / fall);
    EXPECT_GT(verlet, 10.0 * fall);
    EXPECT_LT(numerov, 0.5 * fall);
}

}  // namespace
}  // namespace polargrain
