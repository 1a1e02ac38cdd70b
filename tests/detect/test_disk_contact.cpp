// A disk against a polygon: the depth is the radius less the signed distance of its centre from the outline, and the
// normal the direction in which that grows.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/random.h"
#include "src/detect/contact_finder.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

constexpr double k_radius = 0.01;
const Shape k_disk = Disk("disk", k_radius);

std::optional<ContactGeometry> touch(const Shape& polygon, const Pose& pose, const Vec2& centre,
                                     const Vec2& velocity = Vec2::Zero()) {
    const Pose place{centre, 1.0, 0.0};
    return find_contact({k_disk, place, {velocity, 0.0}}, {polygon, pose, {}});
}

/// By the outline's sides and the winding of its corners about the point; negative inside.
double signed_distance(const PolarPolygon& outline, const Vec2& p) {
    double nearest = std::numeric_limits<double>::infinity();
    double winding = 0.0;
    for (int k = 0; k < outline.size(); ++k) {
        const Vec2 a = outline.vertex(k) - p;
        const Vec2 b = outline.vertex(outline.next(k)) - p;
        const double s = std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (a + s * (b - a)).norm());
        winding += std::atan2(cross(a, b), a.dot(b));
    }
    return winding > 3.0 ? -nearest : nearest;
}

struct Outlines {
    Scene scene = testing::empty_scene(0.5, 0.0);
    std::vector<ShapeIndex> shapes = {testing::add_rectangle(scene, 0.04, 0.02),
                                      testing::add_star(scene, 0.03, 0.012, 5), testing::add_rough(scene, 0.02, 0.1, 7),
                                      testing::add_stick(scene, 0.06, 0.004)};
    const Shape& shape(std::size_t k) const { return scene.shape(shapes[k]); }
};

TEST(DiskOnPolygon, IsAsDeepAsItsRadiusLessItsDistanceFromTheOutline) {
    const Outlines outlines;
    RandomStream random(11, RandomPurpose::test);
    for (int draw = 0; draw < 8000; ++draw) {
        const Shape& shape = outlines.shape(static_cast<std::size_t>(draw % 4));
        const auto& outline = std::get<PolarPolygon>(shape);
        const Pose pose = Pose::at({random.uniform(-1.0, 1.0), 0.5}, random.uniform(-3.0, 3.0));
        const Vec2 local(random.uniform(-0.045, 0.045), random.uniform(-0.045, 0.045));
        const double distance = signed_distance(outline, local);
        const auto contact = touch(shape, pose, pose.to_world(local));
        ASSERT_EQ(contact.has_value(), distance < k_radius) << "draw " << draw;
        if (!contact) continue;
        ASSERT_NEAR(contact->depth, k_radius - distance, 1e-12) << "draw " << draw;
        const double step = 1e-7;
        const double farther = signed_distance(outline, local + step * pose.turned_back(contact->normal));
        ASSERT_NEAR((farther - distance) / step, 1.0, 1e-5) << "draw " << draw;
    }
}

TEST(DiskOnPolygon, NearACornerMeetsTheFaceBelowItWhicheverWayItMoves) {
    Scene scene = testing::empty_scene(1.0, 0.0);
    const Shape& block = scene.shape(testing::add_rectangle(scene, 0.2, 0.1));
    const Pose pose = Pose::at({0.0, -0.05}, 0.0);
    for (const double inboard : {1e-4, 1e-3, 2e-3, 9e-3}) {
        for (const Vec2& velocity : {Vec2(-0.5, -1.0), Vec2(-0.5, 1.0), Vec2(0.5, -1.0), Vec2(0.0, 0.0)}) {
            const auto contact = touch(block, pose, {0.1 - inboard, 0.0095}, velocity);
            ASSERT_TRUE(contact);
            EXPECT_NEAR(contact->depth, 0.0005, 1e-12);
            EXPECT_NEAR(contact->normal.y(), 1.0, 1e-12);
            EXPECT_NEAR(contact->point.x(), 0.1 - inboard, 1e-12);
        }
    }
}

TEST(DiskOnPolygon, GoesOutTheNearestWayWhenItsCentreIsInside) {
    Scene scene = testing::empty_scene(1.0, 0.0);
    const Shape& block = scene.shape(testing::add_rectangle(scene, 0.2, 0.1));
    const Pose pose = Pose::at({0.0, -0.05}, 0.0);
    const auto contact = touch(block, pose, {0.098, -0.001}, {-0.5, -1.0});
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->depth, k_radius + 0.001, 1e-12);
    EXPECT_NEAR(contact->normal.y(), 1.0, 1e-12);
}

TEST(DiskOnPolygon, InANotchMeetsTheFlankThatItApproaches) {
    Scene scene = testing::empty_scene(1.0, 0.0);
    const Shape& star = scene.shape(testing::add_star(scene, 0.2, 0.05, 4));
    const auto& outline = std::get<PolarPolygon>(star);
    int notch = 0;
    for (int k = 0; k < outline.size(); ++k) {
        if (outline.vertex(k).norm() < outline.vertex(notch).norm()) notch = k;
    }
    // In the middle of the notch, a little nearer to one flank than to the other.
    const Vec2 one = outline.normal(notch);
    const Vec2 other = outline.normal(outline.previous(notch));
    const Vec2 out = unit(one + other);
    const Vec2 centre = outline.vertex(notch) + out * (0.9 * k_radius / out.dot(one)) + 1e-4 * other;
    const Pose pose = Pose::at({0.0, 0.0}, 0.0);
    EXPECT_GT(touch(star, pose, centre)->normal.dot(one), 1.0 - 1e-12);
    EXPECT_GT(touch(star, pose, centre, -other + 0.6 * one)->normal.dot(other), 1.0 - 1e-12);
}

}  // namespace
}  // namespace polargrain
