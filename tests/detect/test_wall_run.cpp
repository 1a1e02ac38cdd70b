#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/core/elementary.h"
#include "src/detect/wall_run.h"

namespace polargrain {
namespace {

/// A regular polygon of side 1, counter-clockwise: its inside on the left.
std::vector<Vec2> ring(int sides) {
    std::vector<Vec2> chain;
    const double radius = 0.5 / std::sin(k_pi / sides);
    for (int k = 0; k < sides; ++k) {
        const double angle = 2.0 * k_pi * k / sides;
        chain.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    chain.push_back(chain.front());
    return chain;
}

TEST(WallRun, LeadsRoundTheInsideOfARingUpToARightAngle) {
    // Sides of a twelve-gon bend by 30 degrees: two more lie before a right angle.
    const double expected = std::cos(k_pi / 6.0) + std::cos(k_pi / 3.0);
    const std::vector<Vec2> chain = ring(12);
    for (const std::size_t k : {0U, 5U, 11U}) {
        const WallRun run = run_of_piece(chain, true, k);
        EXPECT_NEAR(run.left_of_a, expected, 1e-12);
        EXPECT_NEAR(run.left_of_b, expected, 1e-12);
        EXPECT_EQ(run.right_of_a, 0.0);
        EXPECT_EQ(run.right_of_b, 0.0);
    }
}

TEST(WallRun, EndsAtFreeEndsStraightJointsAndBendsToTheOtherSide) {
    const std::vector<Vec2> chain{{0.0, 1.0}, {0.5, 0.0}, {1.5, 0.0}, {2.5, 0.0}, {3.5, 1.0}, {4.5, 1.0}};
    const WallRun flat = run_of_piece(chain, false, 1);
    EXPECT_NEAR(flat.left_of_a, 0.5, 1e-12);
    EXPECT_EQ(flat.left_of_b, 0.0) << "the floor goes straight on";
    const WallRun slope = run_of_piece(chain, false, 3);
    EXPECT_NEAR(slope.left_of_a, std::sqrt(0.5), 1e-12) << "as far as the floor's first joint";
    EXPECT_EQ(slope.left_of_b, 0.0);
    EXPECT_NEAR(slope.right_of_b, std::sqrt(0.5), 1e-12) << "under the ledge";
    const WallRun first = run_of_piece(chain, false, 0);
    EXPECT_EQ(first.left_of_a, 0.0);
    EXPECT_NEAR(first.left_of_b, std::sqrt(0.2), 1e-12);
}

TEST(WallRun, IsNoneInABox) {
    const std::vector<Vec2> box{{0.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}};
    for (const std::size_t k : {0U, 1U, 2U}) {
        const WallRun run = run_of_piece(box, false, k);
        for (const double length : {run.left_of_a, run.left_of_b, run.right_of_a, run.right_of_b}) {
            EXPECT_EQ(length, 0.0);
        }
    }
}

}  // namespace
}  // namespace polargrain
