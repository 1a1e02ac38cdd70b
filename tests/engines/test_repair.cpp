#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/core/random.h"
#include "src/engines/contact/repair.h"
#include "tests/support/trial_moves.h"

namespace polargrain {
namespace {

using testing::k_gap;
using testing::k_radius;
using testing::moved_mass;
using testing::same_poses;
using testing::TrialMoves;
using testing::turned_mass;

/// Disks of one radius in a row along x, gaps between neighbours given in resting gaps.
Scene row_of_disks(const std::vector<double>& gaps) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    const ShapeIndex disk = testing::add_disk(scene, k_radius);
    double x = 0.0;
    scene.add(Grain{disk, 0, {x, 0.0}});
    for (const double gap : gaps) {
        x += 2.0 * k_radius + gap * k_gap;
        scene.add(Grain{disk, 0, {x, 0.0}});
    }
    return scene;
}

int repaired(TrialMoves& moves, int sweeps = Repair::k_sweeps) {
    moves.detect();
    return Repair(moves.scene).run(moves.detection, moves.bodies, moves.before, moves.trial, sweeps);
}

/// Between two disks, in resting gaps.
double gap_between(const TrialMoves& moves, GrainIndex a, GrainIndex b) {
    const double apart = (moves.trial.centre[Grains::at(a)] - moves.trial.centre[Grains::at(b)]).norm();
    return (apart - outer_radius(moves.scene.shape_of(a)) - outer_radius(moves.scene.shape_of(b))) / k_gap;
}

/// Ways along x, in resting gaps.
double way_of(const TrialMoves& moves, GrainIndex k) {
    return (moves.trial.centre[Grains::at(k)].x() - moves.before.centre[Grains::at(k)].x()) / k_gap;
}

TEST(Repair, LeavesGrainsThatDoNotOverlapWhereTheyAre) {
    TrialMoves moves(row_of_disks({0.01, 0.5}));
    const PoseSet before = moves.trial;
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_TRUE(same_poses(moves.trial, before));
}

TEST(Repair, OpensTwoDisksToItsGapByWaysThatGoAsTheInverseMasses) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    const Vec2 along = Vec2(0.6, 0.8);
    const double other = 2.0 * k_radius;  // four times the mass
    const double overlap = 0.05 * k_radius;
    scene.add(Grain{testing::add_disk(scene, k_radius), 0, {0.0, 0.0}, 0.7});
    scene.add(Grain{testing::add_disk(scene, other), 0, (k_radius + other - overlap) * along, -0.3});
    TrialMoves moves(scene);
    moves.detect();
    ASSERT_EQ(moves.detection.overlapping(), 1);
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(moves.overlaps(), 0);
    const double opened = overlap + Repair::k_opened * k_gap;
    EXPECT_NEAR((moves.trial.centre[0] - moves.before.centre[0] + 0.8 * opened * along).norm(), 0.0, 1e-15);
    EXPECT_NEAR((moves.trial.centre[1] - moves.before.centre[1] - 0.2 * opened * along).norm(), 0.0, 1e-15);
    EXPECT_EQ(moves.trial.angle, moves.before.angle) << "a push through the centre does not turn a disk";
}

TEST(Repair, RefreshesThePosesOfWhatItMoves) {
    TrialMoves moves(row_of_disks({-1.0}));
    repaired(moves);
    for (const std::size_t k : {0U, 1U}) EXPECT_EQ(moves.trial.pose[k].centre, moves.trial.centre[k]);
}

TEST(Repair, KeepsTheCentreOfMassAndTheAngularMomentumOfPolygons) {
    // A corner in a face, beside both centres.
    Scene scene = testing::empty_scene(0.3, 0.2);
    const double overlap = 1e-5;
    const double lean = 0.25 * std::acos(-1.0);
    const double half_diagonal = std::sqrt(2.0) * 0.005;
    scene.add(Grain{testing::add_rectangle(scene, 0.06, 0.02), 0, {0.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.01, 0.01), 0, {0.02, 0.01 + half_diagonal - overlap}, lean});
    TrialMoves moves(scene);
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(moves.overlaps(), 0);
    const double mass = scene.grains.mass[1];
    EXPECT_NEAR(moved_mass(moves.bodies, moves.before, moves.trial).norm(), 0.0, 1e-12 * mass * overlap);
    // Arms are those before the move: kept to first order in it.
    EXPECT_NEAR(turned_mass(moves.bodies, moves.before, moves.trial), 0.0, 1e-3 * mass * overlap * 0.02);
    EXPECT_LT(moves.trial.angle[0], -1e-5) << "pushed down at its right";
    EXPECT_GT(moves.trial.centre[1].y(), moves.before.centre[1].y() + 0.5 * overlap) << "the lighter one moves farther";
}

TEST(Repair, LiftsAGrainOutOfAWallByItsDepthAndItsGap) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_disk(scene, k_radius), 0, {0.1, k_radius + k_gap}, 0.4});
    TrialMoves moves(scene);
    moves.move(0, {0.0, -4.0 * k_gap});
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(moves.overlaps(), 0);
    EXPECT_NEAR((moves.trial.centre[0] - Vec2(0.1, k_radius + Repair::k_opened * k_gap)).norm(), 0.0, 1e-15);
    EXPECT_EQ(moves.trial.angle[0], 0.4);
}

TEST(Repair, LiftsABoxOutOfAFloorLevel) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.04, 0.02), 0, {0.0, 0.01 + 1e-5}});
    TrialMoves moves(scene);
    moves.move(0, {0.0, -3e-5});
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(moves.overlaps(), 0);
    EXPECT_NEAR(moves.trial.centre[0].y(), 0.01 + Repair::k_opened * moves.resting(), 0.01 * moves.resting());
    EXPECT_NEAR(moves.trial.angle[0], 0.0, 1e-6);
}

TEST(Repair, LetsANeighbourGiveWayRatherThanSqueezeTheGrainBetween) {
    // The first two overlap by half a resting gap, the third is 0.2 of one away. The first two are to come 0.8 apart
    // and the last two may close by 0.1: of equal masses the least sum of squares has 0.5, 0.3 and 0.2 of ways.
    TrialMoves moves(row_of_disks({-0.5, 0.2}));
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(moves.overlaps(), 0);
    EXPECT_NEAR(way_of(moves, 0), -0.5, 1e-9);
    EXPECT_NEAR(way_of(moves, 1), 0.3, 1e-9);
    EXPECT_NEAR(way_of(moves, 2), 0.2, 1e-9);
    EXPECT_NEAR(gap_between(moves, 0, 1), Repair::k_opened, 1e-9);
    EXPECT_NEAR(gap_between(moves, 1, 2), Repair::k_least, 1e-9);
}

TEST(Repair, OpensANeighbourThatIsNearerThanTightToo) {
    TrialMoves moves(row_of_disks({-0.5, 0.5 * Repair::k_tight}));
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_NEAR(gap_between(moves, 0, 1), Repair::k_opened, 1e-9);
    EXPECT_NEAR(gap_between(moves, 1, 2), Repair::k_opened, 1e-9);
}

TEST(Repair, MovesAGrainAwayFromAWallThatStandsBehindItsNeighbour) {
    // Between the overlapping pair and the wall a disk has next to no room: the free end gives way.
    Scene scene = row_of_disks({-0.5, 0.2});
    const double wall = scene.grains.x[2] + k_radius + 0.2 * k_gap;
    testing::add_wall(scene, "right", {{wall, -1.0}, {wall, 1.0}});
    TrialMoves moves(scene);
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(moves.overlaps(), 0);
    const double to_wall = (wall - moves.trial.centre[2].x() - k_radius) / k_gap;
    EXPECT_NEAR(to_wall, Repair::k_least, 1e-5);
    EXPECT_NEAR(gap_between(moves, 1, 2), Repair::k_least, 1e-5);
    EXPECT_NEAR(gap_between(moves, 0, 1), Repair::k_opened, 1e-5);
    EXPECT_NEAR(way_of(moves, 0), -0.6, 1e-5);
}

TEST(Repair, MovesTheFirstRingOfNeighboursOnlyWhereOnePassDoes) {
    // The fourth disk touches the third, which is pushed into it: it is of the second ring, and not needed.
    TrialMoves moves(row_of_disks({-0.5, 0.2, 1.0}));
    EXPECT_EQ(repaired(moves), 0);
    EXPECT_EQ(way_of(moves, 3), 0.0);
}

TEST(Repair, TellsHowManyPairsItLeavesWhereThereIsNoRoom) {
    // Two disks in a slot that is a tenth of a radius too narrow for them.
    Scene scene = testing::empty_scene(0.3, 0.2);
    const double width = 3.9 * k_radius;
    testing::add_box(scene, width, 0.1);
    const ShapeIndex disk = testing::add_disk(scene, k_radius);
    scene.add(Grain{disk, 0, {k_radius + k_gap, 0.02}});
    scene.add(Grain{disk, 0, {width - k_radius - k_gap, 0.02 + 1.5 * k_radius}});
    TrialMoves moves(scene);
    moves.move(1, {0.0, -1.5 * k_radius});
    const int left = repaired(moves);
    EXPECT_GT(left, 0);
    EXPECT_EQ(left, moves.detection.overlapping());
    EXPECT_EQ(left, moves.overlaps());
}

TEST(Repair, WithoutSweepsLeavesEverythingAndSaysSo) {
    TrialMoves moves(row_of_disks({-0.5, 0.2, -0.1}));
    const PoseSet before = moves.trial;
    EXPECT_EQ(repaired(moves, 0), 2);
    EXPECT_TRUE(same_poses(moves.trial, before));
}

/// Bricks in rows, half a brick apart from row to row, with next to no gaps between them.
Scene bricks(int rows, int columns, int threads) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    scene.threads = threads;
    const ShapeIndex brick = testing::add_rectangle(scene, 0.03, 0.02);
    const double pitch = 1.0 + 1e-3;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            scene.add(Grain{brick, 0, {0.03 * pitch * (column + 0.5 * (row % 2)), 0.02 * pitch * row}});
        }
    }
    return scene;
}

void shake(TrialMoves& moves, double way, std::uint64_t seed) {
    RandomStream random(seed, RandomPurpose::test);
    for (GrainIndex k = 0; k < moves.scene.grains.size(); ++k) {
        moves.move(k, way * Vec2(random.normal(), random.normal()), 10.0 * way * random.normal());
    }
}

TEST(Repair, PartsALooseWallOfBricks) {
    int overlapped = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        TrialMoves moves(bricks(5, 5, 1));
        shake(moves, 1.5e-5, seed);
        overlapped += moves.overlaps();
        EXPECT_EQ(repaired(moves), 0) << "seed " << seed;
        EXPECT_EQ(moves.overlaps(), 0) << "seed " << seed;
    }
    EXPECT_GT(overlapped, 40) << "too few to mean anything";
}

TEST(Repair, LeavesEverythingThatIsFarAwayAlone) {
    Scene scene = row_of_disks({-0.5, 50.0, 1.0});
    TrialMoves moves(scene);
    const PoseSet before = moves.trial;
    EXPECT_EQ(repaired(moves), 0);
    for (const std::size_t k : {2U, 3U}) {
        EXPECT_EQ(moves.trial.centre[k], before.centre[k]);
        EXPECT_EQ(moves.trial.angle[k], before.angle[k]);
    }
}

TEST(Repair, OfSeveralClustersIsWhatEachOfThemWouldGetAlone) {
    // Grains that are not connected are solved apart: with a cluster beside it, one moves by the same bits.
    const auto cluster = [](Scene& scene, double y) {
        const ShapeIndex disk = testing::add_disk(scene, k_radius);
        for (const double x : {0.0, 2.0 * k_radius - 1e-5, 4.0 * k_radius - 1.5e-5}) {
            scene.add(Grain{disk, 0, {x, y}});
        }
    };
    Scene one = testing::empty_scene(0.3, 0.2);
    cluster(one, 0.0);
    Scene two = one;
    cluster(two, 0.1);
    TrialMoves alone(one);
    TrialMoves beside(two);
    EXPECT_EQ(repaired(alone), 0);
    EXPECT_EQ(repaired(beside), 0);
    for (const std::size_t k : {0U, 1U, 2U}) {
        EXPECT_EQ(beside.trial.centre[k], alone.trial.centre[k]);
        EXPECT_EQ(beside.trial.centre[k + 3].x(), alone.trial.centre[k].x());
    }
}

TEST(Repair, GivesTheSameBitsOnAnyNumberOfThreads) {
    TrialMoves one(bricks(8, 8, 1));
    TrialMoves three(bricks(8, 8, 3));
    for (TrialMoves* moves : {&one, &three}) shake(*moves, 1.5e-5, 7);
    EXPECT_EQ(repaired(one), repaired(three));
    EXPECT_TRUE(same_poses(one.trial, three.trial));
}

}  // namespace
}  // namespace polargrain
