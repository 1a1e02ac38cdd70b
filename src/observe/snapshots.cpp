#include "src/observe/snapshots.h"

#include <array>
#include <cmath>
#include <utility>

#include "src/observe/bed.h"
#include "src/observe/force_chains.h"
#include "src/observe/free_surface.h"
#include "src/observe/mixing.h"
#include "src/observe/motion.h"
#include "src/observe/structure.h"

namespace polargrain {

namespace {

double ratio(double a, double b) { return b > 0.0 ? a / b : std::nan(""); }

double discharge_rate(const Snapshot& /*about*/, const Sample& s) {
    return ratio(count_out(s.scene, s.world.grains), s.world.time);
}

double coordination(const Snapshot& about, const Sample& s) {
    return coordination_number(s.world.grains, s.report.contacts, about.spec.region);
}

double anisotropy(const Snapshot& about, const Sample& s) {
    const auto fabric = fabric_tensor(s.report.contacts, about.spec.region);
    return fabric ? 2.0 * fabric->deviator() : std::nan("");
}

double fabric_direction(const Snapshot& about, const Sample& s) {
    const auto fabric = fabric_tensor(s.report.contacts, about.spec.region);
    return fabric ? fabric->direction() : std::nan("");
}

double order(const Snapshot& about, const Sample& s) {
    const auto axes = orientation_order(s.scene, s.world.grains, about.mask, about.spec.region);
    return axes ? axes->order : std::nan("");
}

double preferred_direction(const Snapshot& about, const Sample& s) {
    const auto axes = orientation_order(s.scene, s.world.grains, about.mask, about.spec.region);
    return axes ? axes->direction : std::nan("");
}

double mixing_index(const Snapshot& about, const Sample& s) {
    const double cell = about.spec.cell.value_or(8.0 * mean_outer_radius(s.scene));
    return lacey_index(s.scene, s.world.grains, about.mask, cell, about.spec.region);
}

double created_ratio(const Snapshot& /*about*/, const Sample& s) {
    return ratio(s.totals.ledger.rises, initial_energy(s.scene));
}

double rejected_percent(const Snapshot& /*about*/, const Sample& s) {
    return ratio(100.0 * static_cast<double>(s.totals.moves.rejected), static_cast<double>(s.totals.moves.tried));
}

constexpr std::array<std::pair<const char*, Snapshot::Value>, 27> k_snapshots{{
    {"grains_out", [](const Snapshot&, const Sample& s) { return 1.0 * count_out(s.scene, s.world.grains); }},
    {"discharge_rate", discharge_rate},
    {"area_fraction", [](const Snapshot&, const Sample& s) { return area_fraction(s.scene, s.world.grains); }},
    {"potential_over_hexagonal",
     [](const Snapshot&, const Sample& s) { return potential_over_hexagonal(s.scene, s.world.grains); }},
    {"angle_of_repose",
     [](const Snapshot& a, const Sample& s) {
         return std::abs(surface_slope(s.scene, s.world.grains, a.spec.region));
     }},
    {"surface_slope",
     [](const Snapshot& a, const Sample& s) { return surface_slope(s.scene, s.world.grains, a.spec.region); }},
    {"coordination_number", coordination},
    {"fabric_anisotropy", anisotropy},
    {"fabric_direction", fabric_direction},
    {"orientation_order", order},
    {"orientation_direction", preferred_direction},
    {"kinetic_energy_per_grain",
     [](const Snapshot& a, const Sample& s) {
         return kinetic_energy_per_grain(s.world.grains, a.mask, a.spec.region);
     }},
    {"granular_temperature",
     [](const Snapshot& a, const Sample& s) { return granular_temperature(s.world.grains, a.mask, a.spec.region); }},
    {"mean_velocity_x",
     [](const Snapshot& a, const Sample& s) { return mean_velocity(s.world.grains, a.mask, a.spec.region).x(); }},
    {"mean_velocity_y",
     [](const Snapshot& a, const Sample& s) { return mean_velocity(s.world.grains, a.mask, a.spec.region).y(); }},
    {"centre_of_mass_x",
     [](const Snapshot& a, const Sample& s) { return centre_of_mass(s.world.grains, a.mask, a.spec.region).x(); }},
    {"centre_of_mass_y",
     [](const Snapshot& a, const Sample& s) { return centre_of_mass(s.world.grains, a.mask, a.spec.region).y(); }},
    {"force_chains",
     [](const Snapshot&, const Sample& s) {
         return static_cast<double>(find_force_chains(s.world.grains, s.report.contacts).chains.size());
     }},
    {"force_chain_share",
     [](const Snapshot&, const Sample& s) { return find_force_chains(s.world.grains, s.report.contacts).force_share; }},
    {"force_chain_length",
     [](const Snapshot&, const Sample& s) {
         return find_force_chains(s.world.grains, s.report.contacts).mean_length();
     }},
    {"mixing_index", mixing_index},
    {"share_in_region",
     [](const Snapshot& a, const Sample& s) { return share_in_region(s.world.grains, a.mask, *a.spec.region); }},
    {"purity", [](const Snapshot& a, const Sample& s) { return purity(s.world.grains, a.mask, a.spec.region); }},
    {"height_rank", [](const Snapshot& a, const Sample& s) { return height_rank(s.scene, s.world.grains, a.mask); }},
    {"moves_rejected_percent", rejected_percent},
    {"energy_created_ratio", created_ratio},
    {"mean_contacts",
     [](const Snapshot&, const Sample& s) {
         return ratio(static_cast<double>(s.totals.contact_sum), static_cast<double>(s.totals.steps));
     }},
}};

}  // namespace

Snapshot::Value find_snapshot(const std::string& quantity) {
    for (const auto& [name, value] : k_snapshots) {
        if (quantity == name) return value;
    }
    return nullptr;
}

double initial_energy(const Scene& scene) {
    double mass = 0.0;
    for (const double m : scene.grains.mass) mass += m;
    return energy(scene.grains, scene.gravity).total() -
           mass * std::sqrt(scene.gravity.squaredNorm()) * largest_drop(scene).lowest;
}

}  // namespace polargrain
