#include "src/record/summary_reader.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/core/error.h"

namespace polargrain {

double StoredSummary::observable(const std::string& name) const {
    const auto found = observables.find(name);
    return found == observables.end() ? std::nan("") : found->second;
}

double StoredSummary::rejected_share() const {
    return moves_tried > 0 ? static_cast<double>(moves_rejected) / static_cast<double>(moves_tried) : 0.0;
}

StoredSummary read_summary(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "summary.json";
    std::ifstream file(path, std::ios::binary);
    require(file.good(), "{}: cannot be read; is this a finished run folder?", path.string());
    try {
        const nlohmann::json json = nlohmann::json::parse(file);
        StoredSummary summary;
        json.at("engine").get_to(summary.engine);
        json.at("seed").get_to(summary.seed);
        summary.completed = !json.at("interrupted").get<bool>();
        if (json.contains("settling")) summary.at_rest = json.at("settling").at("at_rest").get<bool>();
        json.at("steps").get_to(summary.steps);
        json.at("time_step").get_to(summary.time_step);
        json.at("simulated_seconds").get_to(summary.simulated_seconds);
        json.at("cpu_seconds").get_to(summary.cpu_seconds);
        json.at("grains").get_to(summary.grains);
        json.at("moves").at("tried").get_to(summary.moves_tried);
        json.at("moves").at("rejected").get_to(summary.moves_rejected);
        json.at("state_hash").get_to(summary.state_hash);
        for (const auto& [name, value] : json.at("observables").items()) {
            if (value.is_number()) value.get_to(summary.observables[name]);
        }
        return summary;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: not a summary of ours: {}", path.string(), error.what()));
    }
}

}  // namespace polargrain
