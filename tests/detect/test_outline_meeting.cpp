#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "src/core/random.h"
#include "src/detect/outline_meeting.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

constexpr double k_touching = 2e-5;  // [m]

/// An outline of a scene, which keeps it alive.
const PolarPolygon& outline(const Scene& scene, GrainIndex grain) {
    return std::get<PolarPolygon>(scene.shape_of(grain));
}

Scene two(ShapeIndex (*add)(Scene&, std::uint64_t), std::uint64_t seed) {
    Scene scene = testing::empty_scene(0.5, 0.0);
    for (std::uint64_t k = 0; k < 2; ++k)
        scene.add(Grain{add(scene, 2 * seed + k), 0, {0.05 * static_cast<double>(k), 0.0}});
    return scene;
}

ShapeIndex square(Scene& scene, std::uint64_t) { return testing::add_rectangle(scene, 0.02, 0.02); }
ShapeIndex rough(Scene& scene, std::uint64_t draw) { return testing::add_rough(scene, 0.01, 0.2, draw); }
ShapeIndex star(Scene& scene, std::uint64_t) { return testing::add_star(scene, 0.012, 0.006, 5); }
ShapeIndex stick(Scene& scene, std::uint64_t) { return testing::add_stick(scene, 0.03, 0.003); }

TEST(OutlineMeeting, OfACornerAndAFaceIsAfterTheirDistance) {
    const Scene scene = two(square, 0);
    // Turned by an eighth, the first has a corner ahead, 14.142 mm out; the face of the other is at 60 - 10 mm.
    const Flight tip{{0.0, 0.001}, 0.25 * k_pi, {1.0, 0.3}, 0.0};
    const Flight face{{0.06, 0.0}, 0.0, {-0.5, 0.3}, 0.0};
    const auto m = first_meeting(outline(scene, 0), tip, outline(scene, 1), face, k_touching, 0.0, 0.1);
    ASSERT_TRUE(m);
    EXPECT_NEAR(m->time, (0.05 - 0.01 * std::sqrt(2.0) - k_touching) / 1.5, 1e-15);
    EXPECT_TRUE(m->on_i);
    const Vec2 corner = tip.at(m->time).to_world(outline(scene, 0).vertex(m->vertex));
    EXPECT_NEAR((corner - Vec2(0.01 * std::sqrt(2.0) + m->time, 0.001 + 0.3 * m->time)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((face.at(m->time).turned(outline(scene, 1).normal(m->edge)) + Vec2::UnitX()).norm(), 0.0, 1e-15);
    // The same seen from the other.
    const auto mirror = first_meeting(outline(scene, 1), face, outline(scene, 0), tip, k_touching, 0.0, 0.1);
    ASSERT_TRUE(mirror);
    EXPECT_FALSE(mirror->on_i);
    EXPECT_EQ(mirror->time, m->time);
    EXPECT_EQ(mirror->vertex, m->vertex);
    EXPECT_EQ(mirror->edge, m->edge);
}

TEST(OutlineMeeting, IsSoughtBetweenTheTimesGiven) {
    const Scene scene = two(square, 0);
    const Flight left{{0.0, 0.001}, 0.0, {1.0, 0.0}, 0.0};
    const Flight right{{0.06, 0.0}, 0.0, {-1.0, 0.0}, 0.0};
    const double meet = 0.5 * (0.04 - k_touching);
    const auto between = [&](double from, double to) {
        return first_meeting(outline(scene, 0), left, outline(scene, 1), right, k_touching, from, to);
    };
    EXPECT_FALSE(between(0.0, 0.99 * meet));
    ASSERT_TRUE(between(0.5 * meet, 1.5 * meet));
    EXPECT_NEAR(between(0.5 * meet, 1.5 * meet)->time, meet, 1e-15);
    // Nearer than that already: at once, if they go on, and not at all if they part.
    ASSERT_TRUE(between(meet + 1e-6, 1.5 * meet));
    EXPECT_EQ(between(meet + 1e-6, 1.5 * meet)->time, meet + 1e-6);
    const Flight away{right.centre, 0.0, {3.0, 0.0}, 0.0};
    EXPECT_FALSE(first_meeting(outline(scene, 0), {{0.04, 0.001}, 0.0, {1.0, 0.0}, 0.0}, outline(scene, 1), away,
                               k_touching, 0.0, 0.01));
}

TEST(OutlineMeeting, OfGrainsThatPassIsNone) {
    const Scene scene = two(square, 0);
    const Flight left{{0.0, 0.0}, 0.0, {1.0, 0.0}, 0.0};
    const auto at_height = [&](double y) {
        return first_meeting(outline(scene, 0), left, outline(scene, 1), {{0.06, y}, 0.0, {-1.0, 0.0}, 0.0}, k_touching,
                             0.0, 0.06);
    };
    EXPECT_FALSE(at_height(0.0201));
    EXPECT_TRUE(at_height(0.0199));
    EXPECT_TRUE(at_height(-0.0199));
    EXPECT_FALSE(at_height(-0.0201));
}

/// Distance of the outlines by all vertices and all edges as segments; nothing of the search.
double distance(const PolarPolygon& i, const Pose& pose_i, const PolarPolygon& j, const Pose& pose_j) {
    double least = std::numeric_limits<double>::infinity();
    const auto points_to_edges = [&](const PolarPolygon& own, const Pose& own_pose, const PolarPolygon& other,
                                     const Pose& other_pose) {
        for (int v = 0; v < own.size(); ++v) {
            const Vec2 p = own_pose.to_world(own.vertex(v));
            for (int e = 0; e < other.size(); ++e) {
                const Vec2 a = other_pose.to_world(other.vertex(e));
                const Vec2 along = other_pose.to_world(other.vertex(other.next(e))) - a;
                const double s = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
                least = std::min(least, (p - a - s * along).norm());
            }
        }
    };
    points_to_edges(i, pose_i, j, pose_j);
    points_to_edges(j, pose_j, i, pose_i);
    return least;
}

struct OfShape {
    const char* name;
    ShapeIndex (*add)(Scene&, std::uint64_t);
};

class Outlines : public ::testing::TestWithParam<OfShape> {};

TEST_P(Outlines, MeetWhenTheirDistanceIsGone) {
    constexpr int pairs = 60;
    constexpr double duration = 0.03;
    int met = 0;
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        SCOPED_TRACE(seed);
        RandomStream random(seed, RandomPurpose::test, 0);
        const Scene scene = two(GetParam().add, seed);
        const Flight i{{0.0, 0.0}, 6.0 * random.uniform(), {1.0, 0.0}, 30.0 * random.normal()};
        const Flight j{{0.05, 0.012 * random.normal()}, 6.0 * random.uniform(), {-1.0, 0.0}, 30.0 * random.normal()};
        const PolarPolygon& of_i = outline(scene, 0);
        const PolarPolygon& of_j = outline(scene, 1);
        const auto m = first_meeting(of_i, i, of_j, j, k_touching, 0.0, duration);
        const auto distance_at = [&](double t) { return distance(of_i, i.at(t), of_j, j.at(t)); };
        // What only the arc of a vertex reaches may be passed over: a thousandth of a radius.
        const double passed_over = 1.25e-3 * of_i.outer_radius();
        const double until = m ? m->time : duration;
        for (int n = 0; n < 300; ++n) EXPECT_GT(distance_at(until * n / 300.0), k_touching - passed_over);
        if (!m) continue;
        ++met;
        EXPECT_NEAR(distance_at(m->time), k_touching, 1e-7 * k_touching);
        // It is the vertex and the edge that are said to meet.
        const bool on_i = m->on_i;
        const Pose own = (on_i ? i : j).at(m->time);
        const Pose other = (on_i ? j : i).at(m->time);
        const Vec2 p = other.to_local(own.to_world((on_i ? of_i : of_j).vertex(m->vertex)));
        EXPECT_NEAR(-(on_i ? of_j : of_i).depth(p, m->edge), k_touching, 1e-7 * k_touching);
    }
    EXPECT_GT(met, pairs / 2);
    EXPECT_LT(met, pairs);
}

INSTANTIATE_TEST_SUITE_P(OfShapes, Outlines,
                         ::testing::Values(OfShape{"squares", square}, OfShape{"rough", rough}, OfShape{"stars", star},
                                           OfShape{"sticks", stick}),
                         [](const auto& with) { return std::string(with.param.name); });

}  // namespace
}  // namespace polargrain
