// The four cases of [HN94, Fig. 7], each built by hand; then its mirror image, its A-B swap, and turned and scaled
// copies; then the degenerate ones.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "shapes/outline.h"
#include "src/core/random.h"
#include "src/detect/contact_finder.h"

namespace polargrain {
namespace {

/// Two outlines as drawn in the world (counter-clockwise) and how they move.
struct Drawing {
    std::vector<Vec2> a, b;
    Motion motion_a{}, motion_b{};
};

struct Placed {
    Shape shape;
    Pose pose;
    Motion motion;
    PlacedShape view() const { return {shape, pose, motion}; }
};

Placed place(const std::vector<Vec2>& outline, const Motion& motion) {
    const MassProperties mass = mass_properties("drawn", outline);
    return {prepare_outline("drawn", outline), Pose::at(mass.centroid, 0.0), motion};
}

std::optional<ContactGeometry> contact(const Drawing& drawing) {
    const Placed a = place(drawing.a, drawing.motion_a);
    const Placed b = place(drawing.b, drawing.motion_b);
    return find_contact(a.view(), b.view());
}

Drawing mirrored(Drawing d) {
    for (auto* outline : {&d.a, &d.b}) {
        for (Vec2& p : *outline) p.x() = -p.x();
        std::reverse(outline->begin(), outline->end());
    }
    for (auto* motion : {&d.motion_a, &d.motion_b}) {
        motion->velocity.x() = -motion->velocity.x();
        motion->spin = -motion->spin;
    }
    return d;
}

Drawing turned_and_scaled(Drawing d, double angle, double factor) {
    const Pose turn = Pose::at(Vec2(0.3, -0.7), angle);
    for (auto* outline : {&d.a, &d.b}) {
        for (Vec2& p : *outline) p = turn.to_world(factor * p);
    }
    for (auto* motion : {&d.motion_a, &d.motion_b}) motion->velocity = turn.turned(motion->velocity);
    return d;
}

Drawing swapped(const Drawing& d) { return {d.b, d.a, d.motion_b, d.motion_a}; }

void expect_near(const Vec2& measured, const Vec2& expected, double tolerance = 1e-12) {
    EXPECT_NEAR(measured.x(), expected.x(), tolerance);
    EXPECT_NEAR(measured.y(), expected.y(), tolerance);
}

/// Turning and scaling the drawing turns and scales its contact.
void expect_turned_and_scaled(const Drawing& d, const auto& direct) {
    for (const double angle : {0.4, 1.7, -2.6, k_pi}) {
        for (const double factor : {1e-3, 1.0, 250.0}) {
            const Pose turn = Pose::at(Vec2(0.3, -0.7), angle);
            const auto image = contact(turned_and_scaled(d, angle, factor));
            ASSERT_TRUE(image) << angle << " x " << factor;
            expect_near(image->point, turn.to_world(factor * direct.point), 1e-9 * factor);
            expect_near(image->normal, turn.turned(direct.normal), 1e-9);
            EXPECT_EQ(image->which, direct.which) << to_string(image->which);
            EXPECT_NEAR(image->depth, factor * direct.depth, 1e-9 * factor);
        }
    }
}

/// Checks the drawing itself and all its images against the normal (out of b into a) and case found by hand.
void expect_contact(const Drawing& d, const Vec2& point, const Vec2& normal, NormalCase which) {
    const auto direct = contact(d);
    ASSERT_TRUE(direct);
    expect_near(direct->point, point);
    expect_near(direct->normal, normal);
    EXPECT_EQ(direct->which, which) << to_string(direct->which);

    const auto mirror = contact(mirrored(d));
    ASSERT_TRUE(mirror);
    expect_near(mirror->point, {-point.x(), point.y()});
    expect_near(mirror->normal, {-normal.x(), normal.y()});
    EXPECT_EQ(mirror->which, which) << "mirrored: " << to_string(mirror->which);

    const auto swap = contact(swapped(d));
    ASSERT_TRUE(swap);
    expect_near(swap->point, point);
    expect_near(swap->normal, -normal);
    EXPECT_EQ(swap->which, which) << "swapped: " << to_string(swap->which);

    expect_turned_and_scaled(d, *direct);
}

constexpr double k_down = -1.0;

/// A wide block with its top face at y = 0.
std::vector<Vec2> block() { return {{-2.0, -2.0}, {2.0, -2.0}, {2.0, 0.0}, {-2.0, 0.0}}; }

Motion falling() { return {{0.0, k_down}, 0.0}; }

TEST(ContactNormal, CaseA_OneVertexThroughAFlatFace) {
    const Drawing d{{{0.3, -0.1}, {1.0, 1.0}, {-0.6, 1.1}}, block(), falling(), {}};
    expect_contact(d, {0.3, -0.1}, {0.0, 1.0}, NormalCase::flat);
}

TEST(ContactNormal, CaseB_OneVertexOverACorner) {
    // The tip of a passes over b's corner at the origin: it enters through the left face, leaves through the right one.
    const std::vector<Vec2> wedge{{0.0, 0.0}, {-2.0, -0.3}, {-1.0, -3.0}, {1.0, -3.0}, {2.0, -0.4}};
    const std::vector<Vec2> dart{{0.05, -0.2}, {0.5, 1.0}, {0.0, 1.6}, {-0.5, 0.9}};
    const Drawing d{dart, wedge, falling(), {}};
    // Outer ends of the two crossed edges: (-2, -0.3) and (2, -0.4).
    const Vec2 normal = unit(Vec2(0.1, 4.0));
    expect_contact(d, {0.05, -0.2}, normal, NormalCase::corner);
}

TEST(ContactNormal, CaseC_SeveralVerticesOfTheOwnerOverACorner) {
    // A blunt tooth of a, two vertices wide, straddles b's corner, which is not inside a.
    const std::vector<Vec2> roof{{0.0, 0.0}, {-2.0, -0.5}, {-1.0, -3.0}, {1.0, -3.0}, {2.0, -0.5}};
    const std::vector<Vec2> tooth{{-0.30, -0.3}, {0.0, -0.05}, {0.20, -0.2}, {1.5, 0.9}, {0.0, 1.6}, {-1.5, 0.9}};
    const Drawing d{tooth, roof, falling(), {}};
    expect_contact(d, {-0.30, -0.3}, {0.0, 1.0}, NormalCase::multi_owner);
}

TEST(ContactNormal, CaseD_SeveralVerticesOfTheOtherInside) {
    // a's vertex is deepest, but two vertices of b's blunt top stand inside a: across their chord.
    const std::vector<Vec2> blunt{{0.4, 0.0}, {-0.4, 0.05}, {-1.5, -1.5}, {1.5, -1.5}};
    const std::vector<Vec2> jaw{{0.0, -0.3}, {2.0, -0.35}, {1.8, 1.8}, {-1.8, 1.8}, {-2.0, 0.0}};
    const Drawing d{jaw, blunt, falling(), {}};
    expect_contact(d, {0.0, -0.3}, unit(Vec2(0.05, 0.8)), NormalCase::multi_other);
}

TEST(ContactNormal, ParallelFacesPushAlongTheirNormal) {
    const Drawing d{{{-0.5, -0.01}, {0.5, -0.01}, {0.5, 1.0}, {-0.5, 1.0}}, block(), falling(), {}};
    const auto found = contact(d);
    ASSERT_TRUE(found);
    expect_near(found->normal, {0.0, 1.0});
    EXPECT_NEAR(found->depth, 0.01, 1e-12);
}

TEST(ContactNormal, VertexOnVertexSeparatesTheTwo) {
    // Two squares standing on their corners, one above the other, tips just past each other.
    const double t = 0.02;
    const std::vector<Vec2> upper{{0.0, -t}, {1.0, 1.0 - t}, {0.0, 2.0 - t}, {-1.0, 1.0 - t}};
    const std::vector<Vec2> lower{{0.0, 0.0}, {-1.0, -1.0}, {0.0, -2.0}, {1.0, -1.0}};
    const auto found = contact({upper, lower, falling(), {}});
    ASSERT_TRUE(found);
    expect_near(found->normal, {0.0, 1.0});
}

TEST(ContactNormal, VertexOnTheLineOfAnEdgeIsTouchingNotContact) {
    EXPECT_FALSE(contact({{{0.3, 0.0}, {1.0, 1.0}, {-0.6, 1.1}}, block(), falling(), {}}));
    EXPECT_FALSE(contact({{{-0.5, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {-0.5, 1.0}}, block(), falling(), {}}));
}

TEST(ContactNormal, OneGrainInsideAnotherTakesThePenetratedEdge) {
    const std::vector<Vec2> small{{-0.1, -0.3}, {0.1, -0.3}, {0.1, -0.1}, {-0.1, -0.1}};
    const auto found = contact({small, block(), falling(), {}});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->which, NormalCase::edge);
    expect_near(found->normal, {0.0, 1.0});
}

TEST(ContactNormal, CrossedBarsMeetAcrossTheirCrossing) {
    const std::vector<Vec2> lying{{-2.0, -0.1}, {2.0, -0.1}, {2.0, 0.1}, {-2.0, 0.1}};
    const std::vector<Vec2> standing{{-0.1, -1.8}, {0.1, -1.8}, {0.1, 2.2}, {-0.1, 2.2}};
    const auto found = contact({standing, lying, falling(), {}});
    ASSERT_TRUE(found) << "no vertex of either bar is inside the other";
    expect_near(found->point, {0.0, 0.0});
}

TEST(ContactNormal, PrefersTheDeepestApproachingVertexToADeeperOneThatRecedes) {
    // The block above turns clockwise about its centre: its left lower corner rises, its right one comes down.
    const std::vector<Vec2> tilted{{-1.0, -0.20}, {1.0, -0.10}, {1.0, 1.0}, {-1.0, 1.0}};
    const auto resting = contact({tilted, block(), {{0.0, 0.0}, 0.0}, {}});
    ASSERT_TRUE(resting);
    expect_near(resting->point, {-1.0, -0.2});
    const auto turning = contact({tilted, block(), {{0.0, 0.0}, -1.0}, {}});
    ASSERT_TRUE(turning);
    expect_near(turning->point, {1.0, -0.1});
}

TEST(ContactNormal, FallsBackToTheEdgeWhereTheChordWouldNotClose) {
    // Case (b), but a slides along b's right face so that it recedes along the chord's normal.
    const std::vector<Vec2> wedge{{0.0, 0.0}, {-2.0, -0.3}, {-1.0, -3.0}, {1.0, -3.0}, {2.0, -0.4}};
    const std::vector<Vec2> dart{{0.05, -0.2}, {0.5, 1.0}, {0.0, 1.6}, {-0.5, 0.9}};
    const Vec2 edge = unit(Vec2(0.4, 2.0));
    const Vec2 chord = unit(Vec2(0.1, 4.0));
    const Vec2 sliding{-1.0, 0.03};
    ASSERT_GT(sliding.dot(chord), 0.0);
    ASSERT_LT(sliding.dot(edge), 0.0);
    const auto found = contact({dart, wedge, {sliding, 0.0}, {}});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->which, NormalCase::edge);
    expect_near(found->normal, edge);
}

TEST(ContactNormal, PointsFromOtherToOwnerForRandomConvexPairs) {
    RandomStream random(31, RandomPurpose::test);
    int found = 0;
    for (int n = 0; n < 5000; ++n) {
        const auto polygon = [&](const Vec2& centre) {
            std::vector<Vec2> outline;
            const int sides = 3 + static_cast<int>(random.uniform() * 6);
            const double turn = random.uniform(0.0, 2.0 * k_pi);
            for (int k = 0; k < sides; ++k) {
                const auto [s, c] = sine_cosine(turn + 2.0 * k_pi * k / sides);
                outline.emplace_back(centre.x() + c, centre.y() + s);
            }
            return outline;
        };
        const auto [s, c] = sine_cosine(random.uniform(-k_pi, k_pi));
        const double distance = random.uniform(1.0, 2.0);
        const Vec2 apart{distance * c, distance * s};
        const Drawing d{polygon(apart), polygon(Vec2::Zero()), {-apart, 0.0}, {}};
        const auto touched = contact(d);
        if (!touched || touched->depth > 0.1) continue;
        ++found;
        EXPECT_NEAR(touched->normal.norm(), 1.0, 1e-12);
        EXPECT_GT(touched->normal.dot(apart), 0.0) << "seed 31, pair " << n;
    }
    EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace polargrain
