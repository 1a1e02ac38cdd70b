#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/core/elementary.h"
#include "src/detect/gap_piece.h"

namespace polargrain {
namespace {

/// The pieces of a chain, with their joints and neighbours.
std::vector<GapPiece> pieces_of(const std::vector<Vec2>& chain, bool closed) {
    std::vector<GapPiece> pieces(chain.size() - 1);
    const std::size_t count = pieces.size();
    for (std::size_t k = 0; k < count; ++k) {
        pieces[k].now = {chain[k], chain[k + 1]};
        if (k > 0 || closed) pieces[k].previous = &pieces[(k + count - 1) % count];
        if (k + 1 < count || closed) pieces[k].next = &pieces[(k + 1) % count];
    }
    for (std::size_t k = 0; k + 1 < count + (closed ? 1 : 0); ++k) {
        GapPiece& piece = pieces[k];
        GapPiece& next = pieces[(k + 1) % count];
        const double turn = cross(piece.now.b - piece.now.a, next.now.b - next.now.a);
        piece.at_b = turn > 1e-12 ? Joint::left_turn : turn < -1e-12 ? Joint::right_turn : Joint::straight;
        next.at_a = piece.at_b;
    }
    return pieces;
}

TEST(WallPiece, OfARingBoundsItsInsideUpToARightAngleAwayAndNothingOutside) {
    std::vector<Vec2> ring;
    for (int k = 0; k <= 36; ++k) {
        const double angle = k_pi / 18.0 * (k % 36);
        ring.emplace_back(std::cos(angle), std::sin(angle));
    }
    const std::vector<GapPiece> pieces = pieces_of(ring, true);
    // From the middle of piece 0, by so many pieces, at a distance from the centre.
    const auto place = [](double by, double distance) -> Vec2 {
        const double angle = k_pi / 18.0 * (by + 0.5);
        return distance * Vec2(std::cos(angle), std::sin(angle));
    };
    for (const int by : {-8, -3, -1, 1, 3, 8}) {
        EXPECT_TRUE(pieces[0].bounds_past_end(place(by, 0.98))) << by;
        EXPECT_FALSE(pieces[0].bounds_past_end(place(by, 1.02))) << by;
    }
    for (const int by : {-10, 10}) EXPECT_FALSE(pieces[0].bounds_past_end(place(by, 0.98))) << by;
}

// A rib on a floor: two steep pieces that meet in a tip.
TEST(WallPiece, OfARibBoundsItsOwnSideAlone) {
    const std::vector<GapPiece> pieces = pieces_of({{0.0, 0.0}, {1.0, 0.0}, {1.2, 0.3}, {1.4, 0.0}, {2.4, 0.0}}, false);
    const GapPiece& rising = pieces[1];
    const GapPiece& falling = pieces[2];
    EXPECT_TRUE(rising.bounds_past_end({0.9, 0.05})) << "over the floor before it";
    EXPECT_FALSE(rising.bounds_past_end({1.35, 0.25})) << "beyond the tip";
    EXPECT_FALSE(rising.bounds_past_end({1.2, 0.5})) << "above the tip";
    EXPECT_FALSE(falling.bounds_past_end({1.05, 0.25}));
    EXPECT_TRUE(falling.bounds_past_end({1.5, 0.05}));
    EXPECT_TRUE(pieces[0].bounds_past_end({1.05, 0.2})) << "over the rib's near side";
    EXPECT_FALSE(pieces[0].bounds_past_end({1.5, 0.1})) << "over the floor behind it";
    EXPECT_FALSE(rising.bounds_past_end({1.25, 0.1})) << "within the rib, whose tip turns by more than a right angle";
    EXPECT_FALSE(pieces[0].bounds_past_end({-0.1, 0.1})) << "past a free end";
}

TEST(WallPiece, JointsPointAwayFromTheSideTheyBendTo) {
    const std::vector<GapPiece> pieces = pieces_of({{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}, {3.0, 1.0}}, false);
    EXPECT_TRUE(pieces[1].points_away_from({0.8, 0.5}));
    EXPECT_FALSE(pieces[1].points_away_from({1.2, -0.5}));
    EXPECT_FALSE(pieces[2].points_away_from({1.8, 1.5}));
    EXPECT_TRUE(pieces[2].points_away_from({2.2, 0.5}));
    EXPECT_FALSE(pieces[0].points_away_from({0.5, 0.5})) << "a free end";
}

}  // namespace
}  // namespace polargrain
