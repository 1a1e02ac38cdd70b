#include <gtest/gtest.h>

#include <cmath>

#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/core/random.h"
#include "src/geometry/pose.h"
#include "src/geometry/shape.h"

namespace polargrain {
namespace {

TEST(Disk, HasTheAreaAndTheMomentOfACircle) {
    const Shape disk = Disk("coin", 2.0);
    EXPECT_EQ(name(disk), "coin");
    EXPECT_DOUBLE_EQ(area(disk), 4.0 * k_pi);
    EXPECT_DOUBLE_EQ(polar_moment(disk), 8.0 * k_pi);
    EXPECT_EQ(outer_radius(disk), 2.0);
    EXPECT_EQ(inner_radius(disk), 2.0);
    const Shape half = scaled(disk, 0.5, "small");
    EXPECT_EQ(name(half), "small");
    EXPECT_DOUBLE_EQ(area(half), k_pi);
}

TEST(Disk, RefusesARadiusThatIsNoLength) {
    for (const double radius : {0.0, -1.0, std::nan(""), 1.0 / 0.0}) EXPECT_THROW(Disk("it", radius), InputError);
}

TEST(Shape, OfAPolygonAnswersWithThePolygonsOwnNumbers) {
    const std::vector<Vec2> square = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
    const Shape shape = PolarPolygon("square", square, {4.0, Vec2::Zero(), 8.0 / 3.0});
    EXPECT_EQ(area(shape), 4.0);
    EXPECT_EQ(polar_moment(shape), 8.0 / 3.0);
    EXPECT_DOUBLE_EQ(outer_radius(shape), std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(inner_radius(shape), 1.0);
    EXPECT_EQ(name(scaled(shape, 2.0, "big")), "big");
    EXPECT_EQ(area(scaled(shape, 2.0, "big")), 16.0);
}

TEST(Pose, TakesPointsThereAndBackAndSeenFromAnother) {
    RandomStream random(7, RandomPurpose::test);
    for (int k = 0; k < 1000; ++k) {
        const auto draw = [&] { return Vec2(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)); };
        const Pose a = Pose::at(draw(), random.uniform(-10.0, 10.0));
        const Pose b = Pose::at(draw(), random.uniform(-10.0, 10.0));
        const Vec2 p = draw();
        EXPECT_NEAR((a.to_local(a.to_world(p)) - p).norm(), 0.0, 1e-14);
        EXPECT_NEAR((b.to_world(a.relative_to(b).to_world(p)) - a.to_world(p)).norm(), 0.0, 1e-14);
        EXPECT_NEAR(a.turned(p).norm(), p.norm(), 1e-14);
    }
}

TEST(Pose, OfAPositiveAngleTurnsCounterClockwise) {
    const Pose quarter = Pose::at({1.0, 2.0}, 0.5 * k_pi);
    EXPECT_NEAR((quarter.to_world({1.0, 0.0}) - Vec2(1.0, 3.0)).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace polargrain
