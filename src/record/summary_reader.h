#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace polargrain {

/// What programs ask of the summary.json of a run.
struct StoredSummary {
    std::string engine;
    std::uint64_t seed = 0;
    bool completed = true;        ///< false: interrupted before its duration was over
    std::optional<bool> at_rest;  ///< when the grains had settled before time zero; none: not asked for, or not told
    std::int64_t steps = 0;
    double time_step = 0.0;          ///< [s]
    double simulated_seconds = 0.0;  ///< [s]
    double cpu_seconds = 0.0;        ///< [s]
    std::int64_t grains = 0;
    std::int64_t moves_tried = 0, moves_rejected = 0;
    std::string state_hash;                     ///< of the final state
    std::map<std::string, double> observables;  ///< by name, in SI units; none where the run gave no number

    /// NaN where the run gave none of that name.
    double observable(const std::string& name) const;
    /// Of all moves tried; 0 where none was.
    double rejected_share() const;
};

/// Reads the summary.json of a run folder. InputError names the file where it is absent, damaged or none of ours.
StoredSummary read_summary(const std::filesystem::path& folder);

}  // namespace polargrain
