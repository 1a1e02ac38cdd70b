#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "src/model/scene.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

Wall moving(WallMotion motion) { return {"w", 0, {{0.0, 0.0}, {1.0, 0.0}}, std::move(motion), std::nullopt}; }

const Wall k_piston = moving(LinearMotion{{0.5, -0.25}, 2.0, 6.0});

TEST(LinearMotion, RestsBeforeItsStartGoesSteadilyAndRestsFromItsEndOn) {
    const auto expect = [](double time, const Vec2& way, const Vec2& velocity) {
        const WallState state = wall_state(k_piston, time);
        EXPECT_NEAR((state.point({1.0, 0.0}) - Vec2(1.0, 0.0) - way).norm(), 0.0, 1e-15) << time;
        EXPECT_EQ(state.velocity_at({3.0, 4.0}), velocity) << time;
        EXPECT_EQ(state.spin, 0.0);
    };
    expect(-1.0, {0.0, 0.0}, {0.0, 0.0});
    expect(1.999, {0.0, 0.0}, {0.0, 0.0});
    expect(2.0, {0.0, 0.0}, {0.5, -0.25});
    expect(4.0, {1.0, -0.5}, {0.5, -0.25});
    expect(5.999, {1.9995, -0.99975}, {0.5, -0.25});
    expect(6.0, {2.0, -1.0}, {0.0, 0.0});
    expect(1e6, {2.0, -1.0}, {0.0, 0.0});
    EXPECT_EQ(largest_speed(k_piston), std::sqrt(0.3125));
}

TEST(LinearMotion, WithoutAnEndNeverStops) {
    const Wall wall = moving(LinearMotion{{0.0, 0.125}, 0.0, std::nullopt});
    EXPECT_EQ(wall_state(wall, 1024.0).pose.centre, Vec2(0.0, 128.0));
    EXPECT_EQ(wall_state(wall, 1024.0).velocity, Vec2(0.0, 0.125));
    EXPECT_TRUE(moves_between(wall, 1e6, 1e6 + 1.0));
    EXPECT_EQ(points_at_rest(wall), wall.points);
}

TEST(WallMotion, TellsWhenItIsUnderWay) {
    EXPECT_FALSE(moves_between(k_piston, 0.0, 2.0));
    EXPECT_TRUE(moves_between(k_piston, 1.9, 2.1));
    EXPECT_TRUE(moves_between(k_piston, 3.0, 3.1));
    EXPECT_TRUE(moves_between(k_piston, 5.9, 6.1));
    EXPECT_FALSE(moves_between(k_piston, 6.0, 7.0));
    EXPECT_FALSE(moves_between(moving({}), 0.0, 1.0));
    EXPECT_FALSE(moves_between(moving(RotationMotion{{0.0, 0.0}, 1.0, 0.5}), 0.0, 0.5));
    EXPECT_TRUE(moves_between(moving(SineMotion{{0.0, 1.0}, 1.0, 1.0, 0.5}), 0.0, 0.6));
    EXPECT_FALSE(starts_or_ends(k_piston, 1.5, 1.0));
    EXPECT_TRUE(starts_or_ends(k_piston, 1.5, 1.5));
    EXPECT_FALSE(starts_or_ends(k_piston, 4.0, 4.0));
    EXPECT_TRUE(starts_or_ends(k_piston, 6.0, 0.5));
    EXPECT_FALSE(starts_or_ends(moving(SineMotion{{0.0, 1.0}, 1.0, 1.0, 0.0}), 0.0, 1.0)) << "from the beginning";
}

/// Whatever the steps, the velocities over them take the wall to where it is.
TEST(WallMotion, OverStepsAddsUpToTheWay) {
    for (const double h : {0.1, 0.35, 0.7, 3.0, 12.0}) {
        Vec2 way = Vec2::Zero();
        for (int k = 0; k * h < 12.0; ++k) way += h * wall_state_over(k_piston, (k + 0.5) * h, h).velocity;
        EXPECT_NEAR((way - Vec2(2.0, -1.0)).norm(), 0.0, 1e-12) << h;
    }
    const Wall drum = moving(RotationMotion{{0.0, 0.0}, 0.5, 1.0});
    EXPECT_DOUBLE_EQ(wall_state_over(drum, 1.0, 0.8).spin, 0.25);
    EXPECT_NEAR((wall_state_over(drum, 1.0, 0.8).velocity_at({2.0, 0.0}) - Vec2(0.0, 0.5)).norm(), 0.0, 1e-15);
    const Wall shaker = moving(SineMotion{{0.0, 1.0}, 1e-3, 50.0, 0.0});
    EXPECT_EQ(wall_state_over(shaker, 0.003, 1e-3).velocity, wall_state(shaker, 0.003).velocity);
}

TEST(LargestDrop, GoesFromWhereAWallLiftsToWhereOneStops) {
    Scene scene = testing::empty_scene(0.5, 0.3);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}}, LinearMotion{{0.0, -0.2}, 1.0, 3.0});
    scene.add(Grain{testing::add_disk(scene, 0.01), 0, {0.0, 0.01}});
    EXPECT_DOUBLE_EQ(largest_drop(scene).lowest, -0.4);
    EXPECT_DOUBLE_EQ(largest_drop(scene).height, 0.42);
    EXPECT_DOUBLE_EQ(largest_speed(scene), std::sqrt(2.0 * 9.81 * 0.42) + 0.2);
    scene.walls[0].motion = LinearMotion{{0.1, 0.2}, 1.0, 3.0};
    EXPECT_DOUBLE_EQ(largest_drop(scene).lowest, 0.0);
    EXPECT_DOUBLE_EQ(largest_drop(scene).height, 0.42) << "what is lifted may fall down again";
    scene.walls[0].motion = LinearMotion{{0.2, 0.0}, 1.0, 3.0};
    EXPECT_DOUBLE_EQ(largest_drop(scene).height, 0.02);
    testing::add_wall(scene, "gate", {{0.0, 0.0}, {0.0, 1.0}}, LinearMotion{{0.0, 0.2}, 1.0, 3.0});
    EXPECT_DOUBLE_EQ(largest_drop(scene).height, 0.02) << "a gate that goes along itself lifts nothing";
}

}  // namespace
}  // namespace polargrain
