#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/reader.h"

namespace polargrain {

/// Many runs of one scenario: each value of each parameter with each of the others, with each engine and seed.
struct SweepPlan {
    struct Value {
        std::string text;     ///< TOML
        SourceLocation from;  ///< where it stands in the file
    };
    struct Parameter {
        std::string key;  ///< as after --set: "walls[0].points"
        std::vector<Value> values;
    };

    std::string title;
    std::string text;                   ///< of the file itself
    std::filesystem::path scenario;     ///< file
    std::vector<LaidValue> set;         ///< laid over every run
    std::vector<Parameter> parameters;  ///< by key
    std::vector<Value> engines;         ///< empty: the scenario's own
    std::vector<Value> seeds;           ///< empty: the scenario's own
    bool frames = false;                ///< draw the scenario's frames
};

/// One run of a sweep.
struct SweepRun {
    std::vector<std::string> values;  ///< one per parameter
    ScenarioOverrides overrides;      ///< all that is laid over the scenario
};

/// Reads a sweep file; docs/sweep.md explains it. InputError with file, line, column, key and remedy.
SweepPlan load_sweep(const std::filesystem::path& path);

/// All runs of it: the first parameter changes slowest, then the others, the engine, and the seed fastest.
std::vector<SweepRun> sweep_runs(const SweepPlan& plan);

}  // namespace polargrain
