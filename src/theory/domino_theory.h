#pragma once

#include "src/theory/domino_row.h"

namespace polargrain {

// Closed theories of the speed of a steady toppling wave [sqrt(g L)]. Feet do not slide. NaN where the theory has no
// steady wave. InputError as check(DominoRow).

/// Dominoes behind the head of the wave lean on one another and fall as one group; a collision is plastic, so that e
/// does not enter. With friction between the leaning faces. [L10], after the cooperative group of [SS88].
double group_theory_speed(const DominoRow& row);

/// Each domino strikes the next one once, with restitution and friction, and takes no further part. [S87]
double single_collision_speed(const DominoRow& row);

}  // namespace polargrain
