#pragma once

#include <cstdint>
#include <string>

#include "src/model/engine.h"
#include "src/model/settings.h"

namespace polargrain {

/// The step of a run and how it was come by.
struct TimeStep {
    double dt = 0.0;         ///< [s]
    double suggested = 0.0;  ///< what the engine vouches for [s]; infinite where nothing can move
    std::string origin;      ///< for people: "given as run.time_step", "critical, ..."

    /// Larger than the engine vouches for: grains may pass one another unseen.
    bool too_large() const { return dt > suggested; }
};

/// The step that the settings ask for: the given one, or the engine's suggestion times run.time_step_factor.
/// InputError where the suggestion is asked for and there is none, because nothing can move.
TimeStep choose_time_step(const RunSettings& settings, const Engine& engine);

/// Steps until the first instant at or after the duration [s]; a remainder below a millionth of a step is round-off.
std::int64_t step_count(double duration, double dt);

}  // namespace polargrain
