#pragma once

#include "src/engines/dem/soft_system.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Adds what contacts did during a time `weight` [s] with the velocities at their instant: impulses, work of walls,
/// what normal dashpots took, and the work done against tangential forces, which is friction's but for what stays in
/// springs.
void account_rates(SoftSystem& system, std::span<const double> x, std::span<const double> v, double weight,
                   StepReport& report);

/// Adds what the last accepted evaluation took once: hysteresis, and springs let go under load.
void account_losses(const SoftSystem& system, StepReport& report);

/// Energy in springs [J/m].
struct StoredEnergy {
    double normal = 0.0;
    double sliding = 0.0;
    double total() const { return normal + sliding; }
};

StoredEnergy stored_energy(const SoftSystem& system);

}  // namespace polargrain
