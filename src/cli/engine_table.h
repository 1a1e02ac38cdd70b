#pragma once

#include <memory>
#include <span>
#include <string>

#include "src/model/engine.h"

namespace polargrain {

struct EngineEntry {
    std::string name;
    std::string line;  ///< what it is, for lists
    std::unique_ptr<Engine> (*make)(const Scene&);
};

/// The engines of this build.
std::span<const EngineEntry> engine_table();

/// By its name; InputError tells which engines there are.
const EngineEntry& find_engine(const std::string& name);

}  // namespace polargrain
