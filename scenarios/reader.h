#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/core/error.h"
#include "src/model/settings.h"

namespace polargrain {

/// 2^53: every tool that reads a file with it keeps it exact.
inline constexpr std::int64_t k_largest_seed = 9'007'199'254'740'992;

/// More threads than any machine has; each costs memory.
inline constexpr int k_most_threads = 1024;

/// A value that something else than --set lays over a scenario.
struct LaidValue {
    std::string text;     ///< "key.path=value", as after --set
    SourceLocation from;  ///< what is to blame for it: a place in a sweep file, or another option as its `file`
};

/// What the command line, or a sweep, lays over a scenario file.
struct ScenarioOverrides {
    std::vector<std::string>
        set;  ///< "key.path=value", value in TOML, e.g. "run.duration=2", "walls[0].points=[[0,0],[1,0]]"
    std::optional<std::string> engine = std::nullopt;
    std::optional<std::uint64_t> seed = std::nullopt;
    std::optional<int> threads = std::nullopt;
    bool no_frames = false;
    std::vector<LaidValue> laid = {};  ///< before all others
};

/// Reads, checks and resolves a scenario; places rows and fills. Throws InputError with file, line, column, key and
/// remedy at the first thing that is wrong; has no side effects.
Scenario load_scenario(const std::filesystem::path& path, const ScenarioOverrides& overrides = {});

/// Whether the file is a resolved scenario as a run leaves it behind, and not one that somebody wrote.
bool is_resolved_scenario(const std::filesystem::path& path);

/// Every key that a scenario file takes, as "table.key"; where the keys of a table depend on its type, as
/// "shapes.rectangle.width". For completion and for the test of docs/scenario.md.
std::vector<std::string> known_scenario_keys();

struct ScenarioEntry {
    std::string name;  ///< file name without .toml
    std::string title;
    std::filesystem::path path;
};

/// The folder of shipped scenarios; InputError where it cannot be found.
///
/// Looked for as scenarios in the folder that the environment variable POLARGRAIN_DATA names; if that is not set, in
/// the source tree from which the program was built, then in ../share/polargrain beside the program's folder.
std::filesystem::path scenario_folder();

/// What is in that folder, by name.
std::vector<ScenarioEntry> shipped_scenarios();

/// A file as given, or a shipped scenario by its bare name. InputError names the nearest shipped one otherwise.
std::filesystem::path find_scenario(const std::string& path_or_name);

}  // namespace polargrain
