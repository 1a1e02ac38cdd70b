#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/model/scene.h"
#include "src/run/sink.h"

namespace polargrain {

/// How the grains came to rest before time zero.
struct SettlingSummary {
    bool at_rest = false;
    double seconds = 0.0;       ///< [s] simulated until then
    double at_most = 0.0;       ///< [s] allowed
    double energy = 0.0;        ///< kinetic energy per grain left, over m g R_max
    double until_energy = 0.0;  ///< asked for, in the same unit
};

/// What summary.json says of a run.
struct Summary {
    std::string title;
    std::string source;
    std::string engine;
    std::string version;
    std::string build_flags;
    std::vector<std::string> notes;  ///< what a reader of the numbers has to know
    std::uint64_t seed = 0;
    int threads = 1;
    bool completed = true;                    ///< false: interrupted before its duration was over
    std::optional<SettlingSummary> settling;  ///< none: not asked for
    std::int64_t steps = 0;
    double time_step = 0.0;          ///< [s]
    double simulated_seconds = 0.0;  ///< [s]
    double cpu_seconds = 0.0;        ///< [s]
    double wall_seconds = 0.0;       ///< [s]
    std::int64_t grains = 0;
    std::int64_t grains_out = 0;
    Totals totals;
    Energy initial;
    Energy final_energy;
    std::string state_hash;                     ///< of the final state
    std::map<std::string, double> observables;  ///< by the names in docs/observables.md, in SI units
};

/// Writes the summary as JSON, beside the final place first and then renamed, so that it is whole or absent.
/// Keys stand in a fixed order; docs/run-folder.md lists them. RunError names the file.
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace polargrain
