#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/compare/meters.h"
#include "src/model/engine.h"
#include "src/run/simulation.h"

namespace polargrain {

/// A moment of a run, kept to be drawn.
struct Moment {
    World world;
    StepReport report;
};

/// What is kept of one run, on a clock that is the same for all engines.
struct Track {
    std::string engine;
    std::uint64_t seed = 0;
    double dt = 0.0;  ///< [s]
    std::int64_t steps = 0;
    double simulated_seconds = 0.0;
    double cpu_seconds = 0.0;  ///< of the steps alone: neither measuring nor drawing
    std::string state_hash;    ///< of the final state
    std::vector<Quantity> quantities;
    std::vector<std::vector<double>> readings;  ///< by tick of the clock, then by quantity
    std::vector<double> values;                 ///< by quantity
    std::vector<Moment> moments;                ///< by tick of the clock for pictures

    double cost() const { return simulated_seconds > 0.0 ? cpu_seconds / simulated_seconds : 0.0; }
};

/// The ticks at which runs are looked at [s]; what happens between two is not seen. An engine is looked at at its first
/// step at or after a tick.
struct Clock {
    double every = 0.0;          ///< between readings
    double moments_every = 0.0;  ///< between pictures; 0: none
};

/// Runs the engine on the scene from time zero and takes down its track. The scene outlives the engine.
/// interrupted: receives true where control has stopped the run; the track is not whole then.
Track follow(const Scene& scene, Engine& engine, double dt, double duration, Meters& meters, const Clock& clock,
             const LoopControl& control, bool& interrupted);

}  // namespace polargrain
