#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenarios/reader.h"
#include "src/cli/engine_table.h"
#include "src/run/time_step.h"

namespace polargrain {

/// A scenario that is read and checked, with the engine and the time step it will run with.
struct PreparedRun {
    std::filesystem::path file;
    Scenario scenario;
    const EngineEntry& engine;
    TimeStep time_step;
    std::vector<std::string> notes;  ///< what the engine leaves out or replaces of the scene

    /// Another engine of the same kind, for a scene that outlives it.
    std::unique_ptr<Engine> make_engine(const Scene& scene) const { return engine.make(scene, scenario.engines); }
};

/// Reads the scenario (a file, or the name of a shipped one) and decides engine and time step. InputError names the
/// file. No side effects.
PreparedRun prepare_run(const std::string& scenario, const ScenarioOverrides& overrides);

/// InputError where there are not so many seeds from that of the scenario on.
void require_seeds(const Scenario& scenario, int seeds);

}  // namespace polargrain
