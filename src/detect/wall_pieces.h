#pragma once

#include <span>
#include <vector>

#include "src/detect/overlap.h"
#include "src/model/contact.h"
#include "src/model/wall.h"

namespace polargrain {

/// A straight piece of a wall, where it is at one instant.
struct PlacedPiece {
    WallPiece piece;
    int wall = 0;
    int segment = 0;  ///< which one of its wall's, along the chain
};

/// Appends all pieces of a wall where it is in a state; `number`: of the wall.
void add_pieces(const Wall& wall, int number, const WallState& state, std::vector<PlacedPiece>& pieces);

/// All pieces of the walls present at a time [s], in order of wall and segment. `pieces` is cleared first.
void place_pieces(std::span<const Wall> walls, double time, std::vector<PlacedPiece>& pieces);

/// Motion of a wall's material, as the velocity of the point of it at the world's origin and its spin.
Motion wall_motion(const WallState& state);

}  // namespace polargrain
