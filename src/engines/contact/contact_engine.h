#pragma once

#include <memory>

#include "src/model/engine.h"

namespace polargrain {

/// The refined contact engine, the default: dense beds that are right, and no two grains ever overlap.
///
/// It keeps the spirit of [HN94] (polar outlines, trial configurations, energetic impacts by closing speed, rejection
/// through the dependency graph as the guarantee) and repairs what the literal model gets wrong. A step: impacts and
/// lasting contacts in sub-steps (gap_solver.h), position correction (position_correction.h), detection at the trial
/// poses (gap_detection.h), local repair (repair.h), rejection (rejection.h), energy guard (energy_guard.h).
/// docs/refined-engine.md explains the scheme. The scene must outlive the engine.
std::unique_ptr<Engine> make_contact(const Scene& scene);

}  // namespace polargrain
