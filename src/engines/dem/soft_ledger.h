#pragma once

#include "src/engines/dem/soft_system.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Adds what contacts did during a time `weight` [s] with the velocities at their instant: impulses, work of walls and
/// what dashpots took.
void account_rates(SoftSystem& system, std::span<const double> x, std::span<const double> v, double weight,
                   StepReport& report);

/// Adds what the last accepted evaluation took once: slip, hysteresis, and springs let go under load.
void account_losses(const SoftSystem& system, StepReport& report);

/// Energy in all springs [J/m].
double stored_energy(const SoftSystem& system);

}  // namespace polargrain
