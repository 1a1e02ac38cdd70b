#pragma once

#include <cstddef>
#include <vector>

#include "src/core/vec2.h"

namespace polargrain {

/// How far past its ends the line of a wall piece bounds the free space too. Where a chain goes on bending towards a
/// side, as the inside of a drum does, the free space there lies before the lines of all its pieces.
struct WallRun {
    double left_of_a = 0.0, left_of_b = 0.0;    ///< on the left of the chain, past a and past b [m]
    double right_of_a = 0.0, right_of_b = 0.0;  ///< on its right
};

/// The run of piece k of a chain, from point k to point k + 1; a closed one repeats its first point at the end.
///
/// It ends where the chain goes straight on or bends to the other side, has a free end, has turned by a right angle, or
/// after 32 pieces, which is farther than a grain gets in a step.
WallRun run_of_piece(const std::vector<Vec2>& chain, bool closed, std::size_t k);

}  // namespace polargrain
