#include "src/observe/series_columns.h"

#include <fmt/format.h>

namespace polargrain {

std::vector<std::string> series_columns(const Scene& scene) {
    std::vector<std::string> columns{"time",
                                     "step",
                                     "kinetic_translational",
                                     "kinetic_rotational",
                                     "potential",
                                     "dissipated_normal",
                                     "dissipated_friction",
                                     "wall_work",
                                     "contacts",
                                     "impacts",
                                     "moves_rejected",
                                     "moves_shortened",
                                     "centre_of_mass_x",
                                     "centre_of_mass_y",
                                     "grains_in",
                                     "grains_out",
                                     "energy_correction",
                                     "energy_created",
                                     "energy_rises",
                                     "moves_tried",
                                     "energy_stored"};
    for (const Wall& wall : scene.walls) {
        for (const char* quantity : {"fx", "fy", "torque"}) {
            columns.push_back(fmt::format("wall_{}_{}", wall.name, quantity));
        }
    }
    return columns;
}

}  // namespace polargrain
