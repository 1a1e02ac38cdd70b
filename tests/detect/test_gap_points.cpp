#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shapes/shape_spec.h"
#include "src/detect/gap_points.h"

namespace polargrain {
namespace {

/// Two dominoes one thickness apart: the first has turned about its front foot until its tip is `gap` [m] from the face
/// of the second.
std::vector<GapPoint> leaning_dominoes(double gap) {
    const double height = 0.08;
    const double thickness = 0.0099;
    const Shape plate = make_shape("plate", RectangleSpec{thickness, height, 4}, 1);
    const double lean = std::asin((thickness - gap) / height);
    const Vec2 foot{0.5 * thickness, 0.0};
    const Pose upright = Pose::at(Vec2(-0.5 * thickness, 0.5 * height), 0.0);
    const Pose turn = Pose::at(foot, -lean);
    const Pose leaning = Pose::at(turn.to_world(upright.centre), -lean);
    const Pose standing = Pose::at(Vec2(2.0 * thickness, 0.5 * height), 0.0);
    std::vector<GapPoint> points;
    find_gap_points(plate, standing, plate, leaning, {2e-3, 1e-5}, points);
    return points;
}

TEST(GapPoints, OfALeaningDominoIsItsTipOnTheFaceNotTheNextOnesCornerOnItsExtendedFace) {
    // The upper corner of the next domino is nearer to the line of the leaning one's face than the tip is to the next
    // face, but that face ends before it gets there.
    for (const double gap : {5e-4, 1e-4, 2e-5}) {
        const std::vector<GapPoint> points = leaning_dominoes(gap);
        ASSERT_EQ(points.size(), 1U) << "gap " << gap;
        EXPECT_NEAR(points[0].gap, gap, 1e-12);
        EXPECT_FALSE(points[0].on_i) << "the tip is the leaning domino's";
        EXPECT_NEAR(points[0].normal.x(), 1.0, 1e-12);
    }
}

TEST(GapPoints, OfAGrainThatTouchedAWallStayOnItsSide) {
    // All but touching, its lower corners may have been a hair behind the wall.
    const Shape box = make_shape("box", RectangleSpec{0.02, 0.02, 4}, 1);
    GapPiece floor;
    floor.now = floor.before = {{-1.0, 0.0}, {1.0, 0.0}};
    for (const double was : {-5e-9, -5e-12, -1e-13, 0.0, 1e-13}) {
        for (const double is : {-1e-13, 0.0, 7e-6}) {
            const Pose before = Pose::at(Vec2(0.0, 0.01 + was), 0.0);
            const Pose now = Pose::at(Vec2(0.0, 0.01 + is), 0.0);
            std::vector<GapPoint> points;
            find_gap_points(box, now, before, floor, {2e-3, 2e-5}, points);
            ASSERT_EQ(points.size(), 2U) << "from " << was << " to " << is;
            for (const GapPoint& p : points) {
                EXPECT_NEAR(p.normal.y(), 1.0, 1e-12) << "from " << was << " to " << is;
                EXPECT_NEAR(p.gap, is, 1e-15);
            }
        }
    }
}

}  // namespace
}  // namespace polargrain
