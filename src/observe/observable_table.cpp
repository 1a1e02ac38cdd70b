#include "src/observe/observable_table.h"

#include <algorithm>
#include <array>
#include <utility>

namespace polargrain {

namespace {

using enum Dimension;

const std::vector<ObservableEntry>& table() {
    static const std::vector<ObservableEntry> entries = {
        {"domino_speed", domino_speed, 0, 0, true, "speed of a toppling wave over its steady second half"},
        {"domino_run_in", count, 0, 0, false, "grains that topple before the wave is steady"},

        {"grains_out", count, 0, 0, true, "grains that are below the lowest wall"},
        {"discharge_rate", rate, 0, 0, true, "grains_out over the time simulated"},
        {"grains_passed", count, 0, k_opening | k_kind, false, "grains that have passed an opening since time zero"},
        {"grain_flow", rate, 0, k_opening | k_kind, false, "grains that pass an opening per time"},
        {"flow_rate", area_rate, 0, k_opening | k_kind, false, "area of grains that passes an opening per time"},
        {"bridges", count, k_opening, 0, false, "bridges over an opening since time zero"},
        {"bridge_life", time, k_opening, 0, false, "mean life of the bridges over an opening"},
        {"bridge_time_share", number, k_opening, 0, false, "share of the time during which a bridge stands"},
        {"bridge_grains", count, k_opening, 0, false, "grains in the bridge that stands over an opening"},

        {"area_fraction", number, 0, 0, true, "area of the grains over the area under the top grains"},
        {"potential_over_hexagonal", number, 0, 0, true, "potential energy over that of a hexagonal packing"},
        {"angle_of_repose", angle, 0, k_region, false, "slope of the free surface, without its sign"},
        {"surface_slope", angle, 0, k_region, false, "slope of the free surface, positive where it rises to the right"},
        {"coordination_number", count, 0, k_region, true, "grains and walls that a grain touches"},
        {"fabric_anisotropy", number, 0, k_region, false, "how unevenly contact directions are distributed"},
        {"fabric_direction", angle, 0, k_region, false, "direction in which most contacts point"},
        {"orientation_order", number, 0, k_region | k_kind, false, "nematic order S of the long axes"},
        {"orientation_direction", angle, 0, k_region | k_kind, false, "direction that the long axes prefer"},

        {"kinetic_energy_per_grain", energy, 0, k_region | k_kind, true, "translational and rotational"},
        {"granular_temperature", speed_squared, 0, k_region | k_kind, false,
         "half the mean square of velocities about their mean"},
        {"mean_velocity_x", speed, 0, k_region | k_kind, false, "mean velocity of the grains, to the right"},
        {"mean_velocity_y", speed, 0, k_region | k_kind, false, "mean velocity of the grains, upwards"},
        {"centre_of_mass_x", length, 0, k_region | k_kind, false, "centre of mass of the grains"},
        {"centre_of_mass_y", length, 0, k_region | k_kind, false, "centre of mass of the grains"},

        {"stress_xx", pressure, k_region, 0, false, "contact stress in a region, compression positive"},
        {"stress_xy", pressure, k_region, 0, false, "contact stress in a region, compression positive"},
        {"stress_yy", pressure, k_region, 0, false, "contact stress in a region, compression positive"},
        {"stress_pressure", pressure, k_region, 0, false, "half the trace of the contact stress in a region"},
        {"wall_pressure", pressure, k_wall, k_region, false, "normal force of the grains on a wall over its length"},
        {"wall_weight_share", number, k_wall, k_region, false, "share of the grains' weight that a wall carries"},
        {"force_chains", count, 0, 0, false, "force chains of at least three grains"},
        {"force_chain_share", number, 0, 0, false, "share of the normal force between grains that chains carry"},
        {"force_chain_length", count, 0, 0, false, "mean number of grains in a force chain"},

        {"mixing_index", number, k_kind, k_cell | k_region, false, "Lacey's index: 0 apart, 1 mixed at random"},
        {"share_in_region", number, k_region, k_kind, false, "share of some grains that lies in a region"},
        {"purity", number, k_kind, k_region, false, "share of some grains among those in a region"},
        {"height_rank", number, k_kind, 0, false, "share of the other grains that lie lower than some grains"},

        {"deepest_overlap", length, 0, 0, true, "deepest overlap of any two bodies since time zero"},
        {"moves_rejected_percent", percent, 0, 0, true, "trial moves rejected since time zero"},
        {"energy_created_ratio", number, 0, 0, true, "energy that the method itself made, over E0"},
        {"mean_contacts", count, 0, 0, true, "contacts, mean over the steps"},
    };
    return entries;
}

}  // namespace

std::span<const ObservableEntry> observable_table() { return table(); }

const ObservableEntry* find_observable(std::string_view name) {
    const auto found = std::ranges::find(table(), name, &ObservableEntry::name);
    return found == table().end() ? nullptr : &*found;
}

std::vector<std::string> observable_names() {
    std::vector<std::string> names;
    for (const ObservableEntry& entry : table()) names.push_back(entry.name);
    return names;
}

std::vector<std::string> parameter_keys(std::uint8_t parameters) {
    constexpr std::array k_keys{
        std::pair{k_region, "region"},   std::pair{k_kind, "shape"},      std::pair{k_kind, "material"},
        std::pair{k_kind, "started_in"}, std::pair{k_opening, "opening"}, std::pair{k_wall, "wall"},
        std::pair{k_cell, "cell"},
    };
    std::vector<std::string> keys;
    for (const auto& [bit, key] : k_keys) {
        if ((parameters & bit) != 0) keys.emplace_back(key);
    }
    return keys;
}

}  // namespace polargrain
