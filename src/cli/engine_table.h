#pragma once

#include <memory>
#include <span>
#include <string>

#include "src/model/engine.h"
#include "src/model/engine_settings.h"

namespace polargrain {

struct EngineEntry {
    std::string name;
    std::string line;  ///< what it is, for lists
    std::unique_ptr<Engine> (*make)(const Scene&, const EngineSettings&);
    /// CPU time per grain and step (per part of it, where the engine cuts steps: Engine::parts_of_step) of rough
    /// 24-gons in a settled bed [s], for estimates; loose grains take a third of it, a collapsing bed twice as much.
    /// From polargrain_bench.
    double seconds_per_grain_step;
};

/// The engines of this build.
std::span<const EngineEntry> engine_table();

/// By its name; InputError tells which engines there are.
const EngineEntry& find_engine(const std::string& name);

}  // namespace polargrain
