#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "src/core/random.h"
#include "src/detect/overlap.h"
#include "src/engines/contact/gap_detection.h"
#include "tests/support/scenes.h"
#include "tests/support/trial_moves.h"

namespace polargrain {
namespace {

using testing::place;

/// Two grains of a shape, and where they stand before they move.
struct Pair {
    Scene scene = testing::empty_scene(0.3, 0.2);
    PoseSet before;

    explicit Pair(ShapeIndex (*add)(Scene&)) {
        for (int k = 0; k < 2; ++k) scene.add(Grain{add(scene), 0, {0.012 * k, 0.0}});
        before.resize(2);
    }

    bool overlapping(const PoseSet& poses) const {
        return overlap(scene.shape_of(0), poses.pose[0], scene.shape_of(1), poses.pose[1]);
    }

    /// Side by side, all but touching.
    void put_near(RandomStream& random) {
        place(before, 0, {0.0, 0.0}, random.uniform(-3.0, 3.0));
        const double angle = random.uniform(-3.0, 3.0);
        const double turn = random.uniform(-3.0, 3.0);
        const auto put_at = [&](double distance) {
            place(before, 1, distance * Vec2(std::cos(angle), std::sin(angle)), turn);
        };
        double overlap_at = 0.0;
        double apart_at = outer_radius(scene.shape_of(0)) + outer_radius(scene.shape_of(1));
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (overlap_at + apart_at);
            put_at(middle);
            (overlapping(before) ? overlap_at : apart_at) = middle;
        }
        do {
            put_at(apart_at + random.uniform(0.0, 3e-5));
        } while (overlapping(before));
    }

    /// Vertex 0 of either next to that of the other, in any direction: tips may pass through one another.
    void put_tip_to_tip(RandomStream& random) {
        do {
            for (std::size_t k = 0; k < 2; ++k) {
                const auto& polygon = std::get<PolarPolygon>(scene.shape_of(static_cast<GrainIndex>(k)));
                const Vec2 tip = 1e-5 * Vec2(random.normal(), random.normal());
                const double angle = random.uniform(-3.0, 3.0);
                place(before, k, tip - Pose::at(Vec2::Zero(), angle).turned(polygon.vertex(0)), angle);
            }
        } while (overlapping(before));
    }

    /// Both taken somewhere else, by about `way` in place and turn.
    PoseSet moved(double way, RandomStream& random) const {
        PoseSet now = before;
        for (std::size_t k = 0; k < 2; ++k) {
            const double turn = way * random.normal() / outer_radius(scene.shape_of(static_cast<GrainIndex>(k)));
            place(now, k, before.centre[k] + way * Vec2(random.normal(), random.normal()), before.angle[k] + turn);
        }
        return now;
    }
};

ShapeIndex deep_star(Scene& scene) { return testing::add_star(scene, 0.01, 0.001, 5); }
ShapeIndex rough(Scene& scene) { return testing::add_rough(scene, 0.01, 0.3, 11); }
ShapeIndex stick(Scene& scene) { return testing::add_stick(scene, 0.03, 0.002); }

struct Meeting {
    const char* name;
    ShapeIndex (*shape)(Scene&);
    void (Pair::*put)(RandomStream&);
};

class OverlapFromMotion : public ::testing::TestWithParam<Meeting> {};

// The detection leaves the exact test out where motion and clearance prove that it would say no. It must never differ.
TEST_P(OverlapFromMotion, IsWhatTheExactTestSays) {
    RandomStream random(5, RandomPurpose::test);
    int overlaps = 0;
    int tries = 0;
    for (int draw = 0; draw < 2000; ++draw) {
        Pair pair(GetParam().shape);
        (pair.*GetParam().put)(random);
        GapDetection detection(pair.scene);
        detection.begin_clean();
        const std::vector<SolverBody> bodies(2, SolverBody{{0.01, 0.0}, 0.0, 1.0, 1e4, false});
        for (const double way : {3e-6, 1e-5, 3e-5}) {
            const PoseSet now = pair.moved(way, random);
            detection.detect(pair.before, now, bodies, 0.0, 1e-3, 1e-3);
            const bool told = !detection.pairs().empty() && detection.pairs().front().overlapping;
            ASSERT_EQ(told, pair.overlapping(now)) << "draw " << draw << ", way " << way;
            overlaps += told ? 1 : 0;
            ++tries;
        }
    }
    EXPECT_GT(overlaps, 100) << "of " << tries << ": too few to mean anything";
}

INSTANTIATE_TEST_SUITE_P(Meetings, OverlapFromMotion,
                         ::testing::Values(Meeting{"stars", deep_star, &Pair::put_near},
                                           Meeting{"tips", deep_star, &Pair::put_tip_to_tip},
                                           Meeting{"rough", rough, &Pair::put_near},
                                           Meeting{"sticks", stick, &Pair::put_near}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(GapDetection, TestsEveryPairWhereTheStartMayOverlap) {
    // Two sticks across one another: no vertex of one is near the other.
    Scene scene = testing::empty_scene(0.3, 0.2);
    const ShapeIndex shape = testing::add_stick(scene, 0.03, 0.002);
    PoseSet crossed;
    crossed.resize(2);
    for (int k = 0; k < 2; ++k) {
        scene.add(Grain{shape, 0});
        place(crossed, static_cast<std::size_t>(k), {0.0, 1e-3 * k}, 1.5 * k);
    }
    GapDetection detection(scene);
    detection.detect(crossed, crossed, std::vector<SolverBody>(2), 0.0, 0.0, 1e-3);
    ASSERT_EQ(detection.pairs().size(), 1U);
    EXPECT_TRUE(detection.pairs().front().overlapping);
}

}  // namespace
}  // namespace polargrain
