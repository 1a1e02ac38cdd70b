#pragma once

#include "src/theory/domino_row.h"

namespace polargrain {

/// What becomes of the foot of the domino that strikes while it strikes.
enum class StrikerFoot {
    held,  ///< pinned, as in the theories of the wave
    free,  ///< let go: a floor does not pull, and the blow lifts it
};

/// Friction of the floor from which on the foot of a struck domino does not slide; NaN where the blow lifts it.
///
/// The first of two upright dominoes has turned about its foot until its top corner meets the face of the second, which
/// turns about its front bottom corner. The blow is followed in impulse: sliding under Coulomb friction, which may stop
/// or turn about, and the energetic restitution of [S90]. The ratio of the impulses of the floor along and across
/// itself is what is asked of it. With a held foot the sliding never stops and restitution does not enter:
///     P = 1, w = (b - mu h) / I, I = (1 + h^2) / 3, b = sqrt(1 - lambda^2): |w / 2 - 1| / (w h / 2 + mu).
/// InputError as check(DominoRow).
double foot_friction(const DominoRow& row, StrikerFoot striker);

}  // namespace polargrain
