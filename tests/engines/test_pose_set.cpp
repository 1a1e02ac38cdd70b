#include <gtest/gtest.h>

#include <cmath>

#include "src/engines/contact/pose_set.h"

namespace polargrain {
namespace {

TEST(PoseSet, HasNewGrainsNowhereAndLeavesOldOnesWhereTheyAre) {
    PoseSet poses;
    poses.resize(1);
    poses.centre[0] = {1.0, 2.0};
    poses.resize(3);
    ASSERT_EQ(poses.centre.size(), 3U);
    ASSERT_EQ(poses.angle.size(), 3U);
    ASSERT_EQ(poses.pose.size(), 3U);
    EXPECT_EQ(poses.centre[0], Vec2(1.0, 2.0));
    for (const std::size_t k : {1U, 2U}) {
        EXPECT_TRUE(std::isnan(poses.centre[k].x()) && std::isnan(poses.centre[k].y()));
        EXPECT_NE(poses.centre[k], Vec2::Zero().eval());
    }
}

TEST(PoseSet, RefreshesThePoseOfOneGrainFromItsCentreAndAngle) {
    PoseSet poses;
    poses.resize(2);
    for (std::size_t k = 0; k < 2; ++k) poses.centre[k] = {1.0, 2.0}, poses.angle[k] = 0.5;
    poses.refresh(1);
    EXPECT_EQ(poses.pose[1].centre, Vec2(1.0, 2.0));
    EXPECT_NEAR(
        (poses.pose[1].to_world({2.0, 0.0}) - Vec2(1.0 + 2.0 * std::cos(0.5), 2.0 + 2.0 * std::sin(0.5))).norm(), 0.0,
        1e-15);
    EXPECT_EQ(poses.pose[0].centre, Vec2::Zero().eval()) << "the other one has been left alone";
}

}  // namespace
}  // namespace polargrain
