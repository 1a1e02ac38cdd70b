#pragma once

#include "src/engines/dem/soft_system.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Adds what contacts did during a time `weight` [s] with the velocities at their instant: impulses on and work of
/// walls, what normal dashpots took, and the work done against tangential forces, which is friction's but for what
/// stays in springs.
void account_rates(const SoftSystem& system, std::span<const double> x, std::span<const double> v, double weight,
                   StepReport& report);

/// Adds what the last accepted evaluation took once: hysteresis, and springs let go under load.
void account_losses(const SoftSystem& system, StepReport& report);

}  // namespace polargrain
