#pragma once

#include "src/model/checkpoint.h"
#include "src/model/sample.h"

namespace polargrain {

// States as named arrays, and back, with all their bits.

/// What changes with time: poses and velocities.
void save_motion(Checkpoint& checkpoint, const Grains& grains);
/// Into grains that are there. RunError where their number is another.
void load_motion(const Checkpoint& checkpoint, Grains& grains);

void save(Checkpoint& checkpoint, const Totals& totals);
void load(const Checkpoint& checkpoint, Totals& totals);

/// Without the impact records, which are handed over in the step they belong to.
void save(Checkpoint& checkpoint, const StepReport& report);
void load(const Checkpoint& checkpoint, StepReport& report);

}  // namespace polargrain
