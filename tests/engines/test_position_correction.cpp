#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "src/core/random.h"
#include "src/engines/contact/energy_guard.h"
#include "src/engines/contact/gap_solver.h"
#include "src/engines/contact/position_correction.h"
#include "tests/support/trial_moves.h"

namespace polargrain {
namespace {

using testing::k_gap;
using testing::k_radius;
using testing::moved_mass;
using testing::same_poses;
using testing::TrialMoves;
using testing::turned_mass;

constexpr double k_swept = 3e-3;  ///< what six sweeps leave of a gap, in resting gaps
constexpr double k_all = std::numeric_limits<double>::infinity();

/// Grains after a step, the gaps between them, and the correction of their poses.
struct Correcting {
    TrialMoves at;
    GapSolver solver;
    PositionCorrection correction;
    std::vector<PairContacts> pairs;
    std::vector<GapContact> contacts;
    PositionCorrection::Pace pace{TrialMoves::k_dt, PositionCorrection::k_still};

    explicit Correcting(const Scene& scene) : at(scene), solver(at.scene), correction(at.scene) {
        at.detect();
        at.detection.hand_over(pairs, contacts);
        solver.prepare_at_rest(contacts, at.bodies, at.trial);
    }

    bool needed() const { return correction.needed(contacts, at.bodies, pace); }
    double correct(double budget) {
        return correction.correct(contacts, at.bodies, at.scene.gravity, pace, budget, solver.lanes(), at.trial);
    }
    double energy() const { return total_energy(at.bodies, at.trial, at.scene.gravity, Parallel(1)); }
    double weight(GrainIndex k) const { return at.scene.grains.mass[Grains::at(k)] * at.scene.gravity.norm(); }
    Vec2 way(GrainIndex k) const { return at.trial.centre[Grains::at(k)] - at.before.centre[Grains::at(k)]; }
};

/// Disks over a floor, far from one another; gaps in resting gaps.
Scene disks_on_floor(const std::vector<double>& gaps, double friction = 0.2, double velocity = 0.0) {
    Scene scene = testing::empty_scene(0.3, friction);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {10.0, 0.0}});
    const ShapeIndex disk = testing::add_disk(scene, k_radius);
    for (const double gap : gaps) {
        const double x = 0.05 * scene.grains.size();
        scene.add(Grain{disk, 0, {x, k_radius + gap * k_gap}, 0.0, {velocity, 0.0}});
    }
    return scene;
}

/// Disks in a row, with no weight; gaps between neighbours in resting gaps.
Scene row_without_weight(const std::vector<double>& gaps) {
    Scene scene = testing::empty_scene(0.3, 0.2, 0.0);
    const ShapeIndex disk = testing::add_disk(scene, k_radius);
    double x = 0.0;
    scene.add(Grain{disk, 0, {x, 0.0}});
    for (const double gap : gaps) {
        x += 2.0 * k_radius + gap * k_gap;
        scene.add(Grain{disk, 0, {x, 0.0}});
    }
    return scene;
}

/// Gaps between neighbours in a row, in resting gaps.
std::vector<double> gaps_of_row(const Correcting& row) {
    std::vector<double> gaps;
    for (std::size_t k = 1; k < row.at.trial.centre.size(); ++k) {
        gaps.push_back((row.at.trial.centre[k].x() - row.at.trial.centre[k - 1].x() - 2.0 * k_radius) / k_gap);
    }
    return gaps;
}

TEST(PositionCorrection, OpensAGapByItsPartOfWhatItLacks) {
    for (const double gap : {-0.5, 0.0, 0.1, 0.19}) {
        Correcting bed(disks_on_floor({gap}));
        ASSERT_TRUE(bed.needed());
        const double before = bed.energy();
        const double lift = bed.correct(k_all);
        const double opened = PositionCorrection::k_part * (1.0 - gap) * k_gap;
        EXPECT_NEAR((bed.way(0) - Vec2(0.0, opened)).norm(), 0.0, 1e-6 * k_gap) << "gap " << gap;
        EXPECT_NEAR(lift, bed.weight(0) * opened, 1e-6 * bed.weight(0) * k_gap);
        EXPECT_NEAR(bed.energy() - before, lift, 1e-12 * before);
        EXPECT_EQ(bed.at.trial.angle[0], 0.0);
    }
}

TEST(PositionCorrection, LeavesEverythingWhereNoGapIsBelowItsTrigger) {
    Correcting bed(disks_on_floor({0.21, 0.5, 1.0, 1.4}));
    EXPECT_FALSE(bed.needed());
    EXPECT_EQ(bed.correct(k_all), 0.0);
    EXPECT_TRUE(same_poses(bed.at.trial, bed.at.before));
}

struct Trigger {
    const char* name;
    double friction;
    double stir;  ///< way in a step, in resting gaps
    double trigger;
};
void PrintTo(const Trigger& trigger, std::ostream* out) { *out << trigger.name; }

class TriggerOfCorrection : public ::testing::TestWithParam<Trigger> {};

TEST_P(TriggerOfCorrection, IsThatOfItsPaceAndFriction) {
    const auto [name, friction, stir, trigger] = GetParam();
    const double velocity = stir * k_gap / TrialMoves::k_dt;
    EXPECT_TRUE(Correcting(disks_on_floor({trigger - 0.005}, friction, velocity)).needed());
    EXPECT_FALSE(Correcting(disks_on_floor({trigger + 0.005}, friction, velocity)).needed());
    Correcting falling(disks_on_floor({trigger - 0.005}, friction));
    EXPECT_EQ(falling.needed(), stir == 0.0);
    falling.at.bodies[0].velocity = {0.0, -velocity};
    EXPECT_TRUE(falling.needed()) << "along the normal as along the tangent";
}

INSTANTIATE_TEST_SUITE_P(
    Of, TriggerOfCorrection,
    ::testing::Values(Trigger{"rest", 0.2, 0.0, PositionCorrection::k_still},
                      Trigger{"smooth_rest", 0.0, 0.0, PositionCorrection::k_still_smooth},
                      Trigger{"half_the_pace", 0.2, 0.5 * PositionCorrection::k_stir, 0.45},
                      Trigger{"smooth_at_half_the_pace", 0.0, 0.5 * PositionCorrection::k_stir, 0.6},
                      Trigger{"moving", 0.2, PositionCorrection::k_stir, PositionCorrection::k_trigger},
                      Trigger{"fast", 0.2, 0.9, PositionCorrection::k_trigger}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(PositionCorrection, TriggersPairsAtRestAsHighAsItIsTold) {
    Correcting bed(disks_on_floor({0.65}));
    EXPECT_FALSE(bed.needed());
    bed.pace.still = PositionCorrection::k_trigger;
    EXPECT_TRUE(bed.needed());
}

TEST(PositionCorrection, DoesNotMindContactsThatHaveLeftTheirEdge) {
    Correcting bed(disks_on_floor({0.1}));
    bed.contacts[0].active = false;
    EXPECT_FALSE(bed.needed());
    EXPECT_EQ(bed.correct(k_all), 0.0);
    EXPECT_TRUE(same_poses(bed.at.trial, bed.at.before));
}

TEST(PositionCorrection, AddsItsBudgetAndNoMoreAndScalesAllWaysAndTurns) {
    // Disks, and a box that stands on a corner beside its centre.
    Scene scene = disks_on_floor({0.0, 0.1, -0.2, 1.0});
    const double lean = 0.2;
    const double height = 0.01 * (std::cos(lean) + std::sin(lean));
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.5, height}, lean});
    Correcting whole(scene);
    const double lift = whole.correct(k_all);
    const double turn = whole.at.trial.angle[4] - lean;
    EXPECT_GT(std::abs(turn) * 0.01, 0.01 * k_gap);
    for (const double part : {1e-6, 0.3, 0.999}) {
        Correcting bed(scene);
        const double before = bed.energy();
        const double budget = part * lift;
        EXPECT_NEAR(bed.correct(budget), budget, 1e-12 * lift) << "part " << part;
        EXPECT_NEAR(bed.energy() - before, budget, 1e-12 * before);
        for (GrainIndex k = 0; k < 5; ++k) {
            EXPECT_NEAR((bed.way(k) - part * whole.way(k)).norm(), 0.0, 1e-6 * k_gap) << "grain " << k;
        }
        EXPECT_NEAR(bed.at.trial.angle[4] - lean, part * turn, 1e-6 * std::abs(turn));
    }
    Correcting rich(scene);
    EXPECT_EQ(rich.correct(2.0 * lift), lift) << "what is not needed is not spent";
    EXPECT_TRUE(same_poses(rich.at.trial, whole.at.trial));
}

TEST(PositionCorrection, WithoutABudgetMovesNothing) {
    Correcting bed(disks_on_floor({0.0}));
    EXPECT_EQ(bed.correct(0.0), 0.0);
    EXPECT_TRUE(same_poses(bed.at.trial, bed.at.before));
}

TEST(PositionCorrection, NeverExceedsItsBudgetInABedOfManyShapes) {
    // Ten rough grains side by side and on one another in a box, some with next to no gap.
    int needed = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        RandomStream random(seed, RandomPurpose::test);
        Scene scene = testing::empty_scene(0.3, 0.2);
        testing::add_box(scene, 0.1, 0.1);
        for (int k = 0; k < 10; ++k) {
            const ShapeIndex rough = testing::add_rough(scene, k_radius, 0.2, static_cast<std::uint64_t>(k));
            scene.add(
                Grain{rough, 0, {0.012 + 0.0185 * (k % 5), 0.0102 + 0.0186 * (k / 5)}, random.uniform(-3.0, 3.0)});
        }
        Correcting bed(scene);
        if (!bed.needed()) continue;
        ++needed;
        const double before = bed.energy();
        const double budget = 1e-3 * bed.weight(0) * k_gap;
        const double lift = bed.correct(budget);
        EXPECT_LE(lift, budget * (1.0 + 1e-12)) << "seed " << seed;
        EXPECT_NEAR(bed.energy() - before, lift, 1e-12 * before) << "seed " << seed;
    }
    EXPECT_GT(needed, 10);
}

TEST(PositionCorrection, MovesAPairByWaysThatGoAsTheInverseMassesAndInertias) {
    // A disk over the right half of a plate: m_d up, m_p down, and the plate turns by arm / I of it.
    Scene scene = testing::empty_scene(0.3, 0.2, 0.0);
    const double arm = 0.02;
    scene.add(Grain{testing::add_rectangle(scene, 0.06, 0.02), 0, {0.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, 0.5 * k_radius), 0, {arm, 0.01 + 0.5 * k_radius}});
    Correcting pair(scene);
    ASSERT_EQ(pair.contacts.size(), 1U);
    pair.correct(k_all);
    const SolverBody& plate = pair.at.bodies[0];
    const SolverBody& disk = pair.at.bodies[1];
    const double opened = PositionCorrection::k_part * pair.contacts[0].resting;
    const double push = opened / (plate.inverse_mass + disk.inverse_mass + plate.inverse_inertia * arm * arm);
    EXPECT_NEAR((pair.way(1) - Vec2(0.0, push * disk.inverse_mass)).norm(), 0.0, 1e-9 * opened);
    EXPECT_NEAR((pair.way(0) + Vec2(0.0, push * plate.inverse_mass)).norm(), 0.0, 1e-9 * opened);
    EXPECT_NEAR(pair.at.trial.angle[0], -push * plate.inverse_inertia * arm, 1e-9 * opened / arm);
    EXPECT_NEAR(pair.at.trial.angle[1], 0.0, 1e-9 * opened / arm);
}

TEST(PositionCorrection, KeepsCentreOfMassAndAngularMomentumOfFreeGrains) {
    // Two rows of plates of many sizes, the upper ones astride, most with no gap at all.
    RandomStream random(17, RandomPurpose::test);
    Scene scene = testing::empty_scene(0.3, 0.2, 0.0);
    for (int k = 0; k < 12; ++k) {
        const ShapeIndex plate = testing::add_rectangle(scene, random.uniform(0.02, 0.03), 0.02);
        const int row = k % 2;
        scene.add(Grain{plate, 0, {0.0301 * (k / 2 + 0.5 * row), row * (0.02 + random.uniform(0.0, 1e-5))}});
    }
    Correcting grains(scene);
    grains.correct(k_all);
    ASSERT_FALSE(same_poses(grains.at.trial, grains.at.before));
    double moved = 0.0;
    for (GrainIndex k = 0; k < 12; ++k) moved += grains.way(k).norm() / grains.at.bodies[Grains::at(k)].inverse_mass;
    EXPECT_GT(moved, 0.0);
    EXPECT_NEAR(moved_mass(grains.at.bodies, grains.at.before, grains.at.trial).norm(), 0.0, 1e-11 * moved);
    // Both grains of a contact have their arms to the same point.
    EXPECT_NEAR(turned_mass(grains.at.bodies, grains.at.before, grains.at.trial), 0.0, 1e-11 * moved * 0.1);
}

TEST(PositionCorrection, LetsANeighboursGapCloseToTheTriggerOfMovingPairsAndNoFarther) {
    // 0.1 is opened to 0.1 + 0.3 x 0.9 = 0.37, and 0.75 may close to 0.7: of equal masses the least sum of squares has
    // pushes of 0.49 / 3 and 0.17 / 3.
    Correcting row(row_without_weight({0.1, 0.75}));
    row.correct(k_all);
    EXPECT_NEAR(gaps_of_row(row)[0], 0.37, k_swept);
    EXPECT_NEAR(gaps_of_row(row)[1], 0.7, k_swept);
    EXPECT_NEAR(row.way(0).x() / k_gap, -0.49 / 3.0, k_swept);
    EXPECT_NEAR(row.way(1).x() / k_gap, (0.49 - 0.17) / 3.0, k_swept);
    EXPECT_NEAR(row.way(2).x() / k_gap, 0.17 / 3.0, k_swept);
}

TEST(PositionCorrection, LetsAGapBelowTheTriggerOfMovingPairsNotCloseAtAll) {
    Correcting row(row_without_weight({0.1, 0.4}));
    row.correct(k_all);
    EXPECT_NEAR(gaps_of_row(row)[0], 0.37, k_swept);
    EXPECT_NEAR(gaps_of_row(row)[1], 0.4, k_swept);
}

TEST(PositionCorrection, LeavesANeighbourWithRoomAlone) {
    Correcting row(row_without_weight({0.1, 1.2}));
    row.correct(k_all);
    EXPECT_NEAR(row.way(0).x() / k_gap, -0.135, 1e-6);
    EXPECT_NEAR(row.way(1).x() / k_gap, 0.135, 1e-6);
    EXPECT_EQ(row.way(2), Vec2::Zero().eval());
}

TEST(PositionCorrection, OfAFullRowBetweenWallsPushesNoPairIntoOverlap) {
    // No room: what one pair gains its neighbour loses. Pairs that are pushed deeper into one another would be worse
    // off.
    int needed = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        RandomStream random(seed, RandomPurpose::test);
        std::vector<double> gaps;
        for (int k = 0; k < 12; ++k) gaps.push_back(random.uniform() < 0.7 ? 0.0 : random.uniform(0.0, 0.5));
        Scene scene = row_without_weight(gaps);
        const double right = scene.grains.x.back() + k_radius;
        testing::add_wall(scene, "left", {{-k_radius, 1.0}, {-k_radius, -1.0}});
        testing::add_wall(scene, "right", {{right, -1.0}, {right, 1.0}});
        Correcting row(scene);
        needed += row.needed() ? 1 : 0;
        row.correct(k_all);
        const std::vector<double> after = gaps_of_row(row);
        const double round_off = 1e-9;
        EXPECT_GE(*std::min_element(after.begin(), after.end()), -round_off) << "seed " << seed;
        EXPECT_GE(row.way(0).x() / k_gap, -round_off) << "seed " << seed;
        EXPECT_LE(row.way(12).x() / k_gap, round_off) << "seed " << seed;
    }
    EXPECT_GT(needed, 40);
}

TEST(PositionCorrection, GivesTheSameBitsOnAnyNumberOfThreads) {
    // A lattice of disks with no gaps, thousands of contacts: enough for several strips.
    const auto corrected = [](int threads) {
        Scene scene = testing::empty_scene(0.3, 0.2);
        scene.threads = threads;
        const ShapeIndex disk = testing::add_disk(scene, k_radius);
        RandomStream random(3, RandomPurpose::test);
        for (int k = 0; k < 1500; ++k) {
            const double gap = 0.5 * k_gap * random.uniform();
            scene.add(Grain{disk, 0, {2.0 * k_radius * (k % 100) + gap, 2.0 * k_radius * (k / 100) + gap}});
        }
        Correcting bed(scene);
        bed.correct(k_all);
        EXPECT_GT(bed.contacts.size(), 2000U);
        EXPECT_GT(bed.solver.lanes().groups(), 2U);
        EXPECT_FALSE(same_poses(bed.at.trial, bed.at.before));
        return bed.at.trial;
    };
    EXPECT_TRUE(same_poses(corrected(1), corrected(3)));
}

}  // namespace
}  // namespace polargrain
