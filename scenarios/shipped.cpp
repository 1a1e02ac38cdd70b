#include <toml++/toml.h>

#include <algorithm>

#include "scenarios/reader.h"
#include "src/core/data_folder.h"
#include "src/core/error.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_extension = ".toml";

std::vector<std::string> shipped_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(scenario_folder())) {
        if (entry.path().extension() == k_extension) names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string title_of(const fs::path& path) {
    try {
        return toml::parse_file(path.string())["title"].value_or(path.stem().string());
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        throw InputError(
            {path.string(), static_cast<int>(at.line), static_cast<int>(at.column)},
            fmt::format("not valid TOML: {}; mend the file or take it out of the folder", error.description()));
    }
}

}  // namespace

fs::path scenario_folder() { return data_folder("scenarios"); }

std::vector<ScenarioEntry> shipped_scenarios() {
    std::vector<ScenarioEntry> entries;
    for (const std::string& name : shipped_names()) {
        const fs::path path = scenario_folder() / (name + k_extension);
        entries.push_back({name, title_of(path), path});
    }
    return entries;
}

fs::path find_scenario(const std::string& path_or_name) {
    std::error_code status;
    if (fs::is_regular_file(path_or_name, status)) return path_or_name;
    const bool bare = path_or_name.find('/') == std::string::npos;
    const std::string name = bare ? fs::path(path_or_name).stem().string() : path_or_name;
    const std::vector<std::string> names = shipped_names();
    const bool shipped = std::find(names.begin(), names.end(), name) != names.end();
    if (bare && shipped && (path_or_name == name || path_or_name == name + k_extension)) {
        return scenario_folder() / (name + k_extension);
    }
    require(!fs::is_directory(path_or_name, status), "{}: is a folder; name a scenario file in it", path_or_name);
    const std::string nearest = nearest_name(fs::path(path_or_name).stem().string(), names);
    throw InputError(fmt::format("{}: there is no such scenario file; {}", path_or_name,
                                 nearest.empty() ? fmt::format("shipped are {}", fmt::join(names, ", "))
                                                 : fmt::format("did you mean the shipped \"{}\"?", nearest)));
}

}  // namespace polargrain
