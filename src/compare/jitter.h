#pragma once

#include "src/model/scene.h"

namespace polargrain {

/// Standard deviation of each velocity component that a jitter adds, over sqrt(g R), R the mean outer radius; without
/// gravity over the greatest speed in the scene.
inline constexpr double k_jitter = 1e-3;

/// Makes an initial state one of many alike: adds random velocities, keyed by the scene's seed. No grain is moved.
void add_jitter(Scene& scene);

}  // namespace polargrain
