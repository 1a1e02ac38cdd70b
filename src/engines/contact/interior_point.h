#pragma once

#include <optional>

#include "src/engines/contact/push_system.h"

namespace polargrain {

/// By a primal-dual interior point method with predictor and corrector [M92], from nothing. Its matrix,
/// M + J^T diag(impulse / slack) J, is positive definite although a bed has more contacts than it needs, and of all
/// forces that hold the bed it finds moderate ones. None where round-off takes over before it gets near.
std::optional<PushSolution> solve_interior(PushSystem& system);

}  // namespace polargrain
