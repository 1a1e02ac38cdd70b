#pragma once

#include <cstdint>
#include <string>

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

/// What is known before the first step.
struct RunInfo {
    std::string title;
    std::string source;
    std::string engine;
    double dt = 0.0;        ///< [s]
    double duration = 0.0;  ///< [s]
    Energy initial;         ///< at time zero
    double lowest = 0.0;    ///< height from which potential energy is counted in ratios [m], see Drop
};

/// The state at one instant, handed to a sink; valid only during the call.
struct Sample {
    const Scene& scene;
    const World& world;
    const StepReport& report;  ///< of the last step; empty at time zero
    const Totals& totals;
};

/// Takes what a run produces: a file writer, a painter of frames, a meter. Called from one thread, in order.
class Sink {
public:
    virtual ~Sink() = default;

    /// Interval between samples [s] of simulated time; 0: none but the first and the last.
    virtual double every() const = 0;

    virtual void begin(const Scene& scene, const RunInfo& info) = 0;

    /// After every step, before a sample of the same instant. Keep it cheap.
    virtual void step(const World& /*world*/, double /*dt*/, const StepReport& /*report*/) {}

    /// At time zero, at the first step at or after each multiple of every(), and at the end.
    virtual void sample(const Sample& sample) = 0;

    /// Once, after the last sample, also when the run was interrupted.
    virtual void end() {}
};

}  // namespace polargrain
