#include <array>
#include <set>

#include "scenarios/sections.h"

namespace polargrain {

namespace {

constexpr NumberRange k_stiffness{1e-6, 1e18, "positive (from 1e-6 to 1e18)"};
constexpr NumberRange k_share{0.0, 10.0, "between 0 and 10"};
constexpr NumberRange k_exponent{-0.9, 4.0, "between -0.9 and 4"};
constexpr NumberRange k_target{1e-6, 0.5, "between 1e-6 and 0.5 (of the inner radius)"};
constexpr NumberRange k_area_exponent{1.0, 4.0, "between 1 and 4"};
constexpr NumberRange k_skin{0.0, 5.0, "between 0 and 5 (of a grain's radius)"};
constexpr NumberRange k_resolution{1.0, 1e6, "between 1 and 1e6 steps per contact"};

/// The value of an enumeration whose words stand in its order.
template <typename Enum, std::size_t N>
Enum read_choice(TableReader& table, const char* key, const std::array<std::string, N>& words, Enum fallback) {
    const std::string word = table.choice(key, words, words[static_cast<std::size_t>(fallback)]);
    return static_cast<Enum>(std::find(words.begin(), words.end(), word) - words.begin());
}

const std::array<std::string, 4> k_normal_laws = {"linear", "hertz", "power", "walton-braun"};
const std::array<std::string, 3> k_tangential_laws = {"slider", "spring", "walton-braun"};
const std::array<std::string, 2> k_polygon_contacts = {"area", "potential"};
const std::array<std::string, 4> k_searches = {"direct", "verlet", "nbs", "cgrid"};
const std::array<std::string, 9> k_integrators = {
    "symplectic-euler", "taylor",          "position-verlet", "velocity-verlet", "velocity-verlet-half", "gear4",
    "numerov-central",  "numerov-forward", "numerov-backward"};

/// Keys that [dem] and [[dem.pairs]] share; what is left out is as in `fallback`.
SoftLaw read_law(TableReader& table, const SoftLaw& fallback) {
    SoftLaw law;
    law.normal = read_choice(table, "law", k_normal_laws, fallback.normal);
    law.tangential = read_choice(table, "tangential", k_tangential_laws, fallback.tangential);
    law.tension = table.flag("tension", fallback.tension);
    law.stiffness = table.optional_number("stiffness", k_stiffness);
    if (!law.stiffness && law.normal == fallback.normal) law.stiffness = fallback.stiffness;
    law.exponent = table.number("exponent", k_exponent, fallback.exponent);
    law.damping_exponent = table.optional_number("damping_exponent", k_exponent);
    if (!law.damping_exponent) law.damping_exponent = fallback.damping_exponent;
    law.tangential_stiffness = table.number("tangential_stiffness", k_share, fallback.tangential_stiffness);
    law.tangential_damping = table.number("tangential_damping", k_share, fallback.tangential_damping);
    if (law.exponent != 0.0 && law.normal != NormalLaw::power) {
        table.fail("exponent", "belongs to law = \"power\"; set that, or leave exponent out");
    }
    return law;
}

}  // namespace

void read_dem(Reading& reading) {
    TableReader table = reading.top.table("dem", key_table("dem"));
    DemSettings& settings = reading.scenario.engines.dem;
    settings.law = read_law(table, settings.law);
    settings.target_overlap = table.number("target_overlap", k_target, settings.target_overlap);
    settings.polygons = read_choice(table, "polygons", k_polygon_contacts, settings.polygons);
    settings.area_exponent = table.number("area_exponent", k_area_exponent, settings.area_exponent);
    settings.search = read_choice(table, "search", k_searches, settings.search);
    settings.skin = table.number("skin", k_skin, settings.skin);
    settings.integrator = read_choice(table, "integrator", k_integrators, settings.integrator);
    settings.resolution = table.number("resolution", k_resolution, settings.resolution);
    std::string resolved_pairs;
    std::set<std::pair<MaterialIndex, MaterialIndex>> seen;
    for (const TableItem& item : table.array_of_tables("pairs")) {
        TableReader pair(reading.document, item, key_table("dem.pairs"));
        const auto [a, b] = read_material_pair(reading.scenario.scene, pair, seen);
        settings.pairs.push_back({a, b, read_law(pair, settings.law)});
        append_section(resolved_pairs, "[[dem.pairs]]", pair);
    }
    // In the way of no scenario that is run by another engine.
    if (!reading.top.has("dem") && reading.scenario.run.engine != "dem") return;
    append_section(reading.resolved, "[dem]", table);
    reading.resolved += resolved_pairs;
}

}  // namespace polargrain
