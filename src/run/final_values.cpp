#include "src/run/final_values.h"

#include <cmath>

#include "src/run/observables.h"

namespace polargrain {

double initial_energy(const Scene& scene, const RunInfo& info) {
    double mass = 0.0;
    for (const double m : scene.grains.mass) mass += m;
    const double g = std::sqrt(scene.gravity.squaredNorm());
    return info.initial.total() - mass * g * info.lowest;
}

std::map<std::string, double> final_values(const Scene& scene, const RunInfo& info, const RunState& state) {
    const auto ratio = [](double a, double b) { return b > 0.0 ? a / b : std::nan(""); };
    const auto& [world, totals, next_sample] = state;
    const double grains = world.grains.size();
    const double out = count_out(scene, world.grains);
    std::map<std::string, double> values{
        {"area_fraction", area_fraction(scene, world.grains)},
        {"deepest_overlap", totals.deepest},
        {"discharge_rate", ratio(out, world.time)},
        {"energy_created_ratio", ratio(totals.ledger.rises, initial_energy(scene, info))},
        {"grains_out", out},
        {"kinetic_energy_per_grain", ratio(energy(world.grains, scene.gravity).kinetic(), grains)},
        {"mean_contacts", ratio(static_cast<double>(totals.contact_sum), static_cast<double>(totals.steps))},
        {"moves_rejected_percent",
         ratio(100.0 * static_cast<double>(totals.moves.rejected), static_cast<double>(totals.moves.tried))},
    };
    std::erase_if(values, [](const auto& entry) { return !std::isfinite(entry.second); });
    return values;
}

}  // namespace polargrain
