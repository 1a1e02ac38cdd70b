#pragma once

#include <map>
#include <string>

#include "src/run/simulation.h"

namespace polargrain {

/// E0: kinetic energy, and potential energy above the lowest point of the scene, at time zero [J/m].
double initial_energy(const Scene& scene, const RunInfo& info);

/// Observables that the sums and the last state of a run give, by name, in SI units; docs/observables.md defines each.
/// One that is no number here (a ratio to zero energy) is left out.
std::map<std::string, double> final_values(const Scene& scene, const RunInfo& info, const RunState& state);

}  // namespace polargrain
