#pragma once

#include <functional>
#include <memory>

#include "src/model/engine.h"
#include "src/model/settings.h"
#include "src/run/progress.h"

namespace polargrain {

/// Builds an engine for a scene, which must outlive it.
using EngineFactory = std::function<std::unique_ptr<Engine>(const Scene&)>;

/// What coming to rest led to.
struct Settled {
    Grains grains;         ///< the state that becomes time zero
    Checkpoint engine;     ///< the engine's memory at that instant, for the engine of the scene itself
    double time = 0.0;     ///< [s] simulated until then
    double energy = 0.0;   ///< kinetic energy per grain over m g R_max (means over grains)
    bool at_rest = false;  ///< false: at_most ran out, or stopped
    bool stopped = false;  ///< before its end, by LoopControl::stop: not to be run from
};

/// Kinetic energy of all grains over the sum of m g R_max; zero for no grains.
double rest_energy(const Scene& scene, const Grains& grains);

/// Lets the grains of a scene come to rest: its walls stand still and none is removed meanwhile.
///
/// At rest means that rest_energy stays below settings.until_energy for as long as a grain takes to fall its own
/// radius: grains that are let go start from rest too, but have not come to it. InputError without gravity.
/// control.keep receives a checkpoint before the first step, now and then, and when stopped; given back as `saved`, it
/// carries the settling on as if it had never stopped.
Settled settle(const Scene& scene, const SettleSettings& settings, double dt, const EngineFactory& make_engine,
               const LoopControl& control, const Checkpoint* saved = nullptr);

}  // namespace polargrain
