#include "scenarios/reader.h"

#include <fstream>
#include <string_view>

#include "scenarios/document.h"
#include "scenarios/grain_groups.h"
#include "scenarios/keys.h"
#include "scenarios/sections.h"
#include "scenarios/toml_text.h"

namespace polargrain {

namespace {

constexpr std::string_view k_resolved_head = "# As run by polargrain: every default and override is written out.\n\n";

void read_title(Reading& reading, const std::filesystem::path& path) {
    const std::string name = path.stem().string();
    if (!reading.top.has("title") && !fits_toml(name)) {
        throw InputError({path.string(), 0, 0},
                         "title: is missing, and the name of the file cannot take its place, because it is not UTF-8; "
                         "give the run a title, or the file another name");
    }
    reading.scenario.title = reading.top.text("title", name);
    reading.scenario.source = reading.top.text("source", "");
    reading.resolved += reading.top.resolved_lines();
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& path, const ScenarioOverrides& overrides) {
    const Document document(path, overrides);
    TableReader top(document, key_table(""));
    Scenario scenario;
    std::string resolved(k_resolved_head);
    Reading reading{document, top, scenario, resolved};
    read_title(reading, path);
    read_run(reading);
    read_materials(reading);
    read_pairs(reading);
    ShapeBook shapes = read_shapes(reading);
    read_walls(reading);
    read_settle(reading);
    read_grain_groups(reading, shapes);
    read_dem(reading);
    read_box2d(reading);
    read_output(reading);
    read_expectations(reading);
    top.finish();
    scenario.resolved_toml = std::move(resolved);
    return scenario;
}

bool is_resolved_scenario(const std::filesystem::path& path) {
    std::string head(k_resolved_head.size(), '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    return file.good() && head == k_resolved_head;
}

std::vector<std::string> known_scenario_keys() {
    std::vector<std::string> keys;
    for (const KeyTable& table : key_tables()) {
        std::string prefix = table.path.empty() ? "" : table.path + ".";
        if (!table.variant.empty()) prefix += table.variant + ".";
        for (const std::string& key : table.keys) keys.push_back(prefix + key);
    }
    return keys;
}

}  // namespace polargrain
