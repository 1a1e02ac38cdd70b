#pragma once

#include <cstdint>

#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Sums since time zero.
struct Totals {
    EnergyLedger ledger;
    MoveCount moves;
    std::int64_t impacts = 0;
    std::int64_t steps = 0;
    std::int64_t contact_sum = 0;  ///< contacts summed over steps; over steps: the mean number
    double deepest = 0.0;          ///< deepest overlap of accepted poses so far [m]
};

/// The state at one instant, handed to whoever looks at a run; valid only during the call.
struct Sample {
    const Scene& scene;
    const World& world;
    const StepReport& report;  ///< of the last step; empty at time zero
    const Totals& totals;
};

}  // namespace polargrain
