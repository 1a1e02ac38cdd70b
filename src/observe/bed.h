#pragma once

#include <optional>
#include <vector>

#include "src/model/scene.h"

namespace polargrain {

/// Unit vector against gravity; upwards (y) without gravity.
Vec2 upwards(const Scene& scene);

/// Height of the lowest wall point at rest (see points_at_rest) [m], heights counted from the origin against gravity.
/// None without walls or without gravity: then nothing can be out.
std::optional<double> outlet_height(const Scene& scene);

/// True where a grain with its centre of mass at this place is out: more than its own outer radius [m] below the
/// outlet height. The one rule for grains_in and grains_out; a grain that is carried back up is in again.
bool is_out(const Scene& scene, double outlet, GrainIndex k, const Vec2& position);

/// Number of grains that are out; zero where there is no outlet height. `grains` in the order of the scene's own.
GrainIndex count_out(const Scene& scene, const Grains& grains);

/// The grains that are not out, in rising order.
std::vector<GrainIndex> grains_in(const Scene& scene, const Grains& grains);

/// Mean outer radius of the grains of a scene [m]; NaN without grains.
double mean_outer_radius(const Scene& scene);

/// Least and greatest place of any wall point at rest across gravity [m], on the axis right_normal(upwards).
std::pair<double, double> wall_width(const Scene& scene);

/// Potential energy of the grains above the lowest wall point over the least that as many equal disks can have between
/// the same walls: rows of a hexagonal packing, of disks with the grains' mean mass and mean area. [HN94, sec. 4.2,
/// Fig. 14] NaN without walls, grains or gravity, or where the walls are narrower than a disk.
double potential_over_hexagonal(const Scene& scene, const Grains& grains);

}  // namespace polargrain
