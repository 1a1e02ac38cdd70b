#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "scenarios/reader.h"
#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::PourShape;
using testing::Running;

constexpr double k_diameter = 0.02;

struct PourCase {
    std::string name;
    PourShape shape;
    int grains;
    double friction;
    double dt;                ///< 0: what the engine suggests
    double force_error;       ///< of the floor force, relative: aim 1e-6
    double restlessness;      ///< after 2 s: aim 1e-9
    double weighed_at = 2.0;  ///< [s]
};

std::ostream& operator<<(std::ostream& out, const PourCase& c) { return out << c.name; }

class Pour : public ::testing::TestWithParam<PourCase> {};

TEST_P(Pour, NothingOverlapsTheLedgerClosesAndTheBedRestsWithItsWeightOnTheFloor) {
    const PourCase& c = GetParam();
    const std::uint64_t seed = 1;
    Running sim(make_contact, testing::pour(c.shape, c.grains, seed, 0.3, c.friction));
    const double dt = c.dt > 0.0 ? c.dt : sim.engine->suggested_dt();
    int overlaps = 0;
    sim.run(2.0, dt, [&] {
        if (sim.world.step % 50 == 0) {
            overlaps += testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9);
        }
    });
    const double restlessness = sim.restlessness(k_diameter);
    sim.run(c.weighed_at, dt);
    const double floor_force = -sim.wall_force(0, dt).y() / sim.weight();
    fmt::print("seed {} dt {:.3g}: overlaps {} (0), rejected {:.5f} % (< 0.1), rises {:.2g} E0 (< 1e-9), ", seed, dt,
               overlaps, 100.0 * sim.rejected_share(), sim.ledger.rises / sim.start_energy);
    fmt::print("KE {:.2g} m g d (< 1e-9), floor force / weight - 1 {:.2g} (< 1e-6)\n", restlessness, floor_force - 1.0);
    EXPECT_GT(sim.impacts, 1000) << "they must have met";
    EXPECT_EQ(overlaps, 0);
    EXPECT_LT(sim.rejected_share(), 1e-3);
    EXPECT_LT(sim.ledger_error, 1e-12 * sim.start_energy);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    EXPECT_LT(restlessness, c.restlessness);
    EXPECT_NEAR(floor_force, 1.0, c.force_error);
}

// Frictionless crystals spread their load slowly, most of all where a row fills the box and leans against its walls:
// the grains are at rest long before the last of the weight has found its way to the floor.
INSTANTIATE_TEST_SUITE_P(Shapes, Pour,
                         ::testing::Values(PourCase{"rough", PourShape::rough, 500, 0.2, 1e-3, 1e-6, 1e-9},
                                           PourCase{"smooth_disks", PourShape::disk, 500, 0.0, 0.0, 1e-6, 1e-9, 3.0},
                                           PourCase{"disks", PourShape::disk, 500, 0.3, 1e-3, 1e-6, 1e-9},
                                           PourCase{"stars", PourShape::star, 200, 0.2, 0.0, 1e-6, 1e-9},
                                           PourCase{"sticks", PourShape::stick, 200, 0.2, 0.0, 1e-6, 1e-9},
                                           PourCase{"mixed", PourShape::mixed, 300, 0.2, 0.0, 1e-6, 1e-9}),
                         [](const auto& c) { return c.param.name; });

/// Locked forces wane slowly in sweeps; a bed held still by them would not bear its weight.
TEST(FullRows, OfSmoothDisksComeToRestWithTheirWeightOnTheFloor) {
    for (const std::uint64_t seed : {2, 6, 9, 13}) {  // beds that creep
        ScenarioOverrides overrides;
        overrides.seed = seed;
        Running sim(make_contact, load_scenario(find_scenario("pour-500-disks"), overrides).scene);
        const double dt = 1e-3;
        sim.run(2.0, dt);
        const double floor_force = -sim.wall_force(0, dt).y() / sim.weight();
        fmt::print("seed {}: floor force / weight - 1 {:.2g} (< 1e-6), KE {:.2g} m g d (< 1e-9), rises {:.2g} E0\n",
                   seed, floor_force - 1.0, sim.restlessness(k_diameter), sim.ledger.rises / sim.start_energy);
        EXPECT_NEAR(floor_force, 1.0, 1e-6);
        EXPECT_LT(sim.restlessness(k_diameter), 1e-9);
        EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    }
}

/// How a bed creeps is part of its state.
TEST(FullRows, ThatCreepGoOnFromACheckpointWithTheSameBits) {
    ScenarioOverrides overrides;
    overrides.seed = 2;
    Running whole(make_contact, load_scenario(find_scenario("pour-500-disks"), overrides).scene);
    const double dt = 1e-3;
    Checkpoint checkpoint;
    const auto creeps = [&] {
        whole.engine->save(checkpoint);
        return checkpoint.integers("contact/state").back() != 0;
    };
    while (whole.world.time < 2.0 && !creeps()) whole.step(dt);
    ASSERT_LT(whole.world.time, 2.0);
    Running resumed(make_contact, whole.scene);
    resumed.world = whole.world;
    resumed.engine->load(checkpoint);
    const double later = whole.world.time + 0.1;
    whole.run(later, dt);
    resumed.run(later, dt);
    EXPECT_EQ(state_hash(whole.world), state_hash(resumed.world));
}

/// Rows of disks that fill the box exactly leave no room for resting gaps.
TEST(FullRows, OfSmoothDisksDoNotHalveTheirStepsForEverNorGainEnergy) {
    for (const std::uint64_t seed : {2, 5}) {
        ScenarioOverrides overrides;
        overrides.seed = seed;
        Running sim(make_contact, load_scenario(find_scenario("pour-500-disks"), overrides).scene);
        const double dt = 1e-3;
        sim.run(1.3, dt);
        const std::int64_t tried = sim.moves.tried;
        const std::int64_t step = sim.world.step;
        sim.run(1.5, dt);
        const auto parts =
            static_cast<double>(sim.moves.tried - tried) / 500.0 / static_cast<double>(sim.world.step - step);
        fmt::print(
            "seed {}: rejected {:.4f} % (< 0.1), rises {:.2g} E0 (< 1e-9), created {:.2g} E0, parts of a step at "
            "rest {:.2f} (1)\n",
            seed, 100.0 * sim.rejected_share(), sim.ledger.rises / sim.start_energy,
            sim.ledger.created / sim.start_energy, parts);
        EXPECT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9), 0);
        EXPECT_LT(sim.rejected_share(), 1e-3);
        EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
        EXPECT_EQ(parts, 1.0);
    }
}

class Outline : public ::testing::TestWithParam<std::string> {};

TEST_P(Outline, ComesToRestWithinTwoSeconds) {
    const std::uint64_t seed = 3;
    Running sim(make_contact, testing::pour_outline(GetParam(), 40, 10, seed));
    ASSERT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, 0.0, 1e-9), 0);
    const double dt = sim.engine->suggested_dt();
    int overlaps = 0;
    sim.run(2.0, dt, [&] {
        if (sim.world.step % 100 == 0) {
            overlaps += testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9);
        }
    });
    fmt::print("{}, seed {}, dt {:.3g}: KE {:.2g} m g d (< 1e-9), rejected {:.5f} %, overlaps {}, rises {:.2g} E0\n",
               GetParam(), seed, dt, sim.restlessness(k_diameter), 100.0 * sim.rejected_share(), overlaps,
               sim.ledger.rises / sim.start_energy);
    EXPECT_EQ(overlaps, 0);
    EXPECT_LT(sim.rejected_share(), 1e-3);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    EXPECT_LT(sim.restlessness(k_diameter), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Library, Outline, ::testing::ValuesIn(testing::shipped_outlines()),
                         [](const auto& c) { return testing::test_name(c.param); });

}  // namespace
}  // namespace polargrain
