#include "src/reproduce/recorded_run.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "src/core/error.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t comma = std::min(line.find(',', begin), line.size());
        fields.push_back(line.substr(begin, comma - begin));
        begin = comma + 1;
    }
    return fields;
}

double number(std::string_view field) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    return error == std::errc() && end == field.data() + field.size() ? value : std::nan("");
}

}  // namespace

double RecordedRun::observable(const std::string& name) const {
    const auto found = observables.find(name);
    return found == observables.end() ? std::nan("") : found->second;
}

RecordedRun read_run(const fs::path& folder) {
    const fs::path path = folder / "summary.json";
    std::ifstream file(path);
    require(file.good(), "{}: cannot be read; is this a finished run folder?", path.string());
    try {
        const nlohmann::json json = nlohmann::json::parse(file);
        RecordedRun run;
        run.engine = json.at("engine");
        run.cpu_seconds = json.at("cpu_seconds");
        run.simulated_seconds = json.at("simulated_seconds");
        run.time_step = json.at("time_step");
        run.grains = json.at("grains");
        run.steps = json.at("steps");
        const double tried = json.at("moves").at("tried");
        run.rejected_share = tried > 0.0 ? json.at("moves").at("rejected").get<double>() / tried : 0.0;
        run.state_hash = json.at("state_hash");
        for (const auto& [name, value] : json.at("observables").items()) {
            if (value.is_number()) run.observables[name] = value;
        }
        run.energy_created = run.observable("energy_created_ratio");
        return run;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: not a summary of ours: {}", path.string(), error.what()));
    }
}

std::map<std::string, std::vector<double>> read_columns(const fs::path& csv) {
    std::ifstream file(csv);
    std::string line;
    require(file.good() && std::getline(file, line), "{}: cannot be read, or is empty", csv.string());
    std::vector<std::string> names;
    for (const std::string_view name : fields_of(line)) names.emplace_back(name);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(file, line)) {
        const std::vector<std::string_view> fields = fields_of(line);
        if (fields.size() != names.size()) continue;  // a last row cut short
        for (std::size_t c = 0; c < names.size(); ++c) columns[names[c]].push_back(number(fields[c]));
    }
    return columns;
}

}  // namespace polargrain
