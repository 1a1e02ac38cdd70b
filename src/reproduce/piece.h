#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/model/engine.h"

namespace polargrain {

/// A simulation that a figure rests on.
struct Piece {
    std::string name;      ///< letters, digits and dashes; begins the name of its folder
    std::string scenario;  ///< text of a scenario file, engine and seed in it
    std::string engine;    ///< the one that the scenario names
};

/// An engine of this build.
struct EngineAtHand {
    std::string name;
    std::function<std::unique_ptr<Engine>(const Scene&)> make;
};

/// Fingerprint of what an engine computes: the state hash of a small crowded scene after some steps. It changes with
/// the engine's arithmetic, and not with anything else in the program.
std::string engine_fingerprint(const EngineAtHand& engine);

/// Sixteen hexadecimal digits that stand for everything a piece's result depends on: its scenario, and what its engine
/// computes.
std::string piece_key(const Piece& piece, const std::string& fingerprint);

}  // namespace polargrain
