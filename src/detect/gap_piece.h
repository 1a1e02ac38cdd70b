#pragma once

#include <cstdint>

#include "src/detect/overlap.h"

namespace polargrain {

/// How a wall goes on at the end of a piece, on the way along the chain.
enum class Joint : std::uint8_t { free_end, straight, left_turn, right_turn };

/// A wall piece as seen by grains near it.
struct GapPiece {
    WallPiece now;     ///< where it is at the pose that is looked at
    WallPiece before;  ///< where it was at the grain's last pose that did not overlap
    Joint at_a = Joint::free_end, at_b = Joint::free_end;
    const GapPiece* previous = nullptr;  ///< the chain's piece that ends in a; none at a free end
    const GapPiece* next = nullptr;      ///< the one that begins in b
    bool one_sided = false;              ///< acts on its left side only: a moving wall, which may have run over a grain

    /// Does the joint at a point away from a place? It lies before the lines of both pieces then, and meets them before
    /// it could come to where they join.
    bool points_away_from(const Vec2& place) const;

    /// Does the line of the piece bound the free space at a place p past one of its ends, on the side on which p is?
    ///
    /// Where a chain goes on bending towards a side, as the inside of a drum does, the free space there lies before the
    /// lines of all its pieces. So p has to lie before all pieces from this one to that over which it is, which may be
    /// a right angle and 32 pieces away.
    bool bounds_past_end(const Vec2& p) const;
};

}  // namespace polargrain
