#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace polargrain {

/// Numbers of a finished run folder.
struct RecordedRun {
    std::string engine;
    double cpu_seconds = 0.0, simulated_seconds = 0.0, time_step = 0.0;
    double grains = 0.0, steps = 0.0;
    double rejected_share = 0.0;                ///< of all moves tried
    double energy_created = 0.0;                ///< sum of rises over the initial energy above the lowest point
    std::map<std::string, double> observables;  ///< by name; none where the run gave none
    std::string state_hash;

    /// NaN where the run gave none of that name.
    double observable(const std::string& name) const;
};

/// Reads summary.json of a run folder. InputError names the file where it is absent or none of ours.
RecordedRun read_run(const std::filesystem::path& folder);

/// Columns of a CSV file by their names; every field a number, others as NaN. InputError names the file.
std::map<std::string, std::vector<double>> read_columns(const std::filesystem::path& csv);

}  // namespace polargrain
