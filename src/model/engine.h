#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/model/checkpoint.h"
#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// A way to take a step. Built for one Scene, which outlives it.
class Engine {
public:
    virtual ~Engine() = default;

    /// The name in scenario files: "contact-1994", ...
    virtual std::string_view name() const = 0;

    /// What of its scene the engine leaves out or replaces, a sentence each; for the log of a run.
    virtual std::vector<std::string> notes() const { return {}; }

    /// Largest time step [s] that the engine vouches for in this scene; infinite where nothing can move.
    virtual double suggested_dt() const = 0;

    /// InputError where it could not take a single step of dt [s] in its scene, which is more than suggested_dt.
    virtual void check_dt(double /*dt*/) const {}

    /// Number of parts that the engine cuts a step of dt [s] into; each costs about as much.
    virtual double parts_of_step(double /*dt*/) const { return 1.0; }

    /// Takes the world from time t to t + dt: poses, velocities, step and time (= step x dt). Fills the report.
    virtual void step(World& world, double dt, StepReport& report) = 0;

    /// Everything beside the World that the next step depends on. load(save()) changes no later bit.
    virtual void save(Checkpoint& checkpoint) const = 0;
    virtual void load(const Checkpoint& checkpoint) = 0;
};

}  // namespace polargrain
