#pragma once

#include <optional>

#include "src/model/observable_spec.h"
#include "src/model/scene.h"

namespace polargrain {

// The top of a bed as one sees it against gravity. The grains that count have their centres between the outermost wall
// points and not below the lowest one; heights [m] are above the latter.

/// Area between the walls under the top grains [m^2]: the integral across the walls of the height at which a line along
/// gravity, from above, first meets a grain, zero where it meets none. By lines a 64th of a mean outer diameter apart.
/// [HN94, sec. 4.2: "integrating the area under the top disks"] None without walls, grains or gravity.
std::optional<double> area_under_tops(const Scene& scene, const Grains& grains);

/// Area of the grains over the area under the top grains. [HN94, sec. 4.2] NaN without walls, grains or gravity.
double area_fraction(const Scene& scene, const Grains& grains);

/// Slope of the free surface against the horizontal [rad], positive where it rises along right_normal(upwards): a
/// straight line of least squares through the tops of columns some two mean outer radii wide, each as high as the top
/// (centre plus outer radius) of the highest grain whose centre stands in it; without the outer fifth of the columns on
/// either side, or, with a region, through all columns whose top lies in it. NaN with fewer than three columns.
double surface_slope(const Scene& scene, const Grains& grains, const std::optional<Region>& region);

}  // namespace polargrain
