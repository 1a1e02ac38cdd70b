#pragma once

#include <optional>

#include "src/engines/contact/push_system.h"

namespace polargrain {

/// From those pushes that act, starting with the ones that the system guesses: held at their least openings, they
/// leave a linear problem, solved by the method of multipliers, which pushes more than are needed do no harm [B82].
/// Those that come out pulling are let go, those whose gaps close too fast are added. None where that does not come to
/// an end: the guess was too far off. Of all forces that hold the bed it finds those near the guess.
std::optional<PushSolution> solve_active(PushSystem& system);

}  // namespace polargrain
