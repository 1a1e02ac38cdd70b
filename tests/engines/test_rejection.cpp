#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/core/random.h"
#include "src/detect/overlap.h"
#include "src/engines/contact/rejection.h"
#include "tests/support/trial_moves.h"

namespace polargrain {
namespace {

using testing::k_radius;
using testing::TrialMoves;

/// Disks at these places, with velocities that they keep unless they are stopped.
Scene disks_at(const std::vector<Vec2>& places) {
    Scene scene = testing::empty_scene(0.3, 0.2);
    const ShapeIndex disk = testing::add_disk(scene, k_radius);
    for (const Vec2& place : places) scene.add(Grain{disk, 0, place, 0.5, {0.3, -0.4}, 2.0});
    return scene;
}

int rejected(TrialMoves& moves) {
    moves.detect();
    return Rejection(moves.scene).run(moves.detection, moves.before, moves.trial, moves.bodies);
}

/// Is a grain back where it stood, and stopped?
bool stays(const TrialMoves& moves, GrainIndex grain) {
    const std::size_t k = Grains::at(grain);
    const SolverBody& body = moves.bodies[k];
    return moves.trial.centre[k] == moves.before.centre[k] && moves.trial.angle[k] == moves.before.angle[k] &&
           moves.trial.pose[k].centre == moves.before.pose[k].centre &&
           moves.trial.pose[k].sine == moves.before.pose[k].sine && body.velocity == Vec2::Zero() && body.spin == 0.0 &&
           body.touched;
}

/// Is a grain where `tried` has taken it, with the velocity that it had?
bool has_moved(const TrialMoves& moves, const PoseSet& tried, GrainIndex grain) {
    const std::size_t k = Grains::at(grain);
    const SolverBody& body = moves.bodies[k];
    return moves.trial.centre[k] == tried.centre[k] && moves.trial.angle[k] == tried.angle[k] &&
           body.velocity == moves.scene.grains.velocity(grain) && body.spin == moves.scene.grains.spin[k] &&
           !body.touched;
}

/// Who stays; the others have to have moved as they tried.
std::vector<GrainIndex> who_stays(const TrialMoves& moves, const PoseSet& tried) {
    std::vector<GrainIndex> found;
    for (GrainIndex k = 0; k < moves.scene.grains.size(); ++k) {
        if (stays(moves, k)) {
            found.push_back(k);
        } else {
            EXPECT_TRUE(has_moved(moves, tried, k)) << "grain " << k << " has neither moved nor stayed";
        }
    }
    return found;
}

using Indices = std::vector<GrainIndex>;

TEST(RejectedMoves, LetsAllMoveWhereNothingOverlaps) {
    // Each of the two goes where the other was: their trial poses are clear of one another.
    TrialMoves moves(disks_at({{0.0, 0.0}, {0.03, 0.0}}));
    moves.move(0, {0.03, 0.0}, 0.1);
    moves.move(1, {-0.03, 0.0}, 0.2);
    const PoseSet tried = moves.trial;
    EXPECT_EQ(rejected(moves), 0);
    EXPECT_EQ(who_stays(moves, tried), Indices{});
}

TEST(RejectedMoves, OfARowThatRunsIntoAWallTakesAllThatFollowedAndNobodyElse) {
    // The first grain (2) runs into the wall; 0 and 3 follow it, each to where the one before was. 1 follows too, but
    // at a distance: it comes no farther than it may. 4 goes its own way.
    const double d = 2.0 * k_radius + 1e-4;
    Scene scene = disks_at({{-d, 0.0}, {-3.5 * d, 0.0}, {0.0, 0.0}, {-2.0 * d, 0.0}, {0.0, 0.1}});
    const double wall = k_radius + 1e-4;
    testing::add_wall(scene, "right", {{wall, -1.0}, {wall, 0.05}});
    TrialMoves moves(scene);
    for (const GrainIndex k : {0, 1, 2, 3, 4}) moves.move(k, {0.3 * k_radius, 0.0}, 0.1);
    const PoseSet tried = moves.trial;
    EXPECT_EQ(rejected(moves), 3);
    EXPECT_EQ(who_stays(moves, tried), (Indices{0, 2, 3}));
    EXPECT_EQ(moves.overlaps(), 0);
    EXPECT_EQ(moves.detection.overlapping(), 0);
}

/// Grains 0 and 1 make for the same place from the left and from below; grain 0 is followed by `behind_0`, grain 1 by
/// `behind_1` others.
TrialMoves two_that_collide(int behind_0, int behind_1) {
    const double d = 2.0 * k_radius + 5e-4;
    std::vector<Vec2> places{{-0.03, 0.0}, {0.0, -0.03}};
    for (int k = 1; k <= behind_0; ++k) places.emplace_back(-0.03 - k * d, 0.0);
    for (int k = 1; k <= behind_1; ++k) places.emplace_back(0.0, -0.03 - k * d);
    return TrialMoves(disks_at(places));
}

void rush(TrialMoves& moves, int behind_0) {
    for (GrainIndex k = 0; k < moves.scene.grains.size(); ++k) {
        const bool from_left = k == 0 || (k >= 2 && k < 2 + behind_0);
        moves.move(k, from_left ? Vec2(0.025, 0.0) : Vec2(0.0, 0.025));
    }
}

TEST(RejectedMoves, OfTwoThatCollideStopsTheOneWithFewerDependants) {
    const auto who = [](int behind_0, int behind_1) {
        TrialMoves moves = two_that_collide(behind_0, behind_1);
        rush(moves, behind_0);
        const PoseSet tried = moves.trial;
        const int count = rejected(moves);
        const Indices stay = who_stays(moves, tried);
        EXPECT_EQ(static_cast<std::size_t>(count), stay.size());
        EXPECT_EQ(moves.overlaps(), 0);
        return stay;
    };
    EXPECT_EQ(who(1, 0), (Indices{1}));
    EXPECT_EQ(who(0, 1), (Indices{0}));
    EXPECT_EQ(who(2, 1), (Indices{1, 4})) << "with the one that follows it";
    EXPECT_EQ(who(1, 2), (Indices{0, 2}));
    EXPECT_EQ(who(0, 0), (Indices{0})) << "of equals the lower number";
}

TEST(RejectedMoves, StopsGrainsThatOverlapWallsFirst) {
    // 0 and 1 collide, and 0, which nobody follows, would be the one to stay. But 1 is in the wall: it stays, and 0,
    // whose way is then free, goes on.
    Scene scene = disks_at({{0.0, 0.0}, {0.03, 0.0}, {0.06, 0.0}});
    testing::add_wall(scene, "floor", {{0.02, -k_radius - 1e-4}, {1.0, -k_radius - 1e-4}});
    TrialMoves moves(scene);
    moves.move(0, {0.002, 0.009});
    moves.move(1, {-0.011, -0.002});
    moves.move(2, {-0.012, 0.001});
    const PoseSet tried = moves.trial;
    EXPECT_EQ(rejected(moves), 2);
    EXPECT_EQ(who_stays(moves, tried), (Indices{1, 2})) << "2 would follow 1";
    EXPECT_EQ(moves.overlaps(), 0);
}

TEST(RejectedMoves, StopsARingThatWaitsForItself) {
    // Four grains go round, each to where the next one was. All can go at once; with one of them stopped by a wall,
    // none.
    for (const bool blocked : {false, true}) {
        Scene scene = disks_at({{-0.015, -0.015}, {0.015, -0.015}, {0.015, 0.015}, {-0.015, 0.015}});
        if (blocked)
            testing::add_wall(scene, "right", {{0.015 + k_radius + 1e-4, 0.0}, {0.015 + k_radius + 1e-4, 0.1}});
        TrialMoves moves(scene);
        moves.move(0, {0.03, 0.0});
        moves.move(1, {0.001, 0.03});
        moves.move(2, {-0.03, 0.0});
        moves.move(3, {0.0, -0.03});
        const PoseSet tried = moves.trial;
        EXPECT_EQ(rejected(moves), blocked ? 4 : 0);
        EXPECT_EQ(who_stays(moves, tried), blocked ? (Indices{0, 1, 2, 3}) : Indices{});
    }
}

struct Throw {
    const char* name;
    testing::PourShape shape;
    double way;  ///< radii
};

void PrintTo(const Throw& thrown, std::ostream* out) { *out << thrown.name; }

class ThrownAbout : public ::testing::TestWithParam<Throw> {};

// Every grain moves or stays as a whole, nothing overlaps afterwards, and nobody stays without a cause: a wall, another
// grain's trial pose, or the place of one that stays.
TEST_P(ThrownAbout, NothingOverlapsAndNobodyStaysWithoutACause) {
    int stopped = 0;
    int moved = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        TrialMoves moves(testing::pour(GetParam().shape, 60, seed, 0.3, 0.2, 8));
        ASSERT_EQ(moves.overlaps(), 0);
        RandomStream random(seed, RandomPurpose::test, 1);
        const GrainIndex n = moves.scene.grains.size();
        for (GrainIndex k = 0; k < n; ++k) {
            const double way = GetParam().way * k_radius;
            moves.move(k, way * Vec2(random.normal(), random.normal()), random.normal());
        }
        const PoseSet tried = moves.trial;
        moves.detect();
        std::vector<char> cause(Grains::at(n), 0);
        for (const PairContacts& pair : moves.detection.pairs()) {
            if (!pair.overlapping) continue;
            cause[Grains::at(pair.i)] = 1;
            if (!is_wall(pair.j)) cause[Grains::at(pair.j)] = 1;
        }
        const int count = Rejection(moves.scene).run(moves.detection, moves.before, moves.trial, moves.bodies);
        EXPECT_EQ(moves.overlaps(), 0) << "seed " << seed;
        EXPECT_EQ(moves.detection.overlapping(), 0) << "seed " << seed;
        const Indices stay = who_stays(moves, tried);
        ASSERT_EQ(static_cast<std::size_t>(count), stay.size());
        for (const GrainIndex k : stay) {
            for (const GrainIndex other : stay) {
                if (k == other || cause[Grains::at(k)]) continue;
                cause[Grains::at(k)] = overlap(moves.scene.shape_of(k), tried.pose[Grains::at(k)],
                                               moves.scene.shape_of(other), moves.before.pose[Grains::at(other)]);
            }
            EXPECT_TRUE(cause[Grains::at(k)]) << "seed " << seed << ", grain " << k;
        }
        stopped += count;
        moved += n - count;
    }
    EXPECT_GT(stopped, 40) << "too few to mean anything";
    EXPECT_GT(moved, 40);
}

INSTANTIATE_TEST_SUITE_P(Grains, ThrownAbout,
                         ::testing::Values(Throw{"disks", testing::PourShape::disk, 0.5},
                                           Throw{"rough", testing::PourShape::rough, 0.4},
                                           Throw{"stars", testing::PourShape::star, 0.3},
                                           Throw{"sticks", testing::PourShape::stick, 0.3},
                                           Throw{"mixed", testing::PourShape::mixed, 0.3}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace polargrain
