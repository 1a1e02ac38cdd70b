#pragma once

#include <optional>

#include "src/model/scene.h"

namespace polargrain {

/// Height of the lowest wall point at time zero [m], heights counted from the origin against gravity.
/// None without walls or without gravity: then nothing can be out.
std::optional<double> outlet_height(const Scene& scene);

/// True where a grain with its centre of mass at this place is out: more than its own outer radius [m] below the
/// outlet height. The one rule for grains_in and grains_out; a grain that is carried back up is in again.
bool is_out(const Scene& scene, double outlet, GrainIndex k, const Vec2& position);

/// Number of grains that are out; zero where there is no outlet height. `grains` in the order of the scene's own.
GrainIndex count_out(const Scene& scene, const Grains& grains);

/// Area of the grains over the area under their surface, both counted from the lowest point of the walls.
///
/// The surface: the width of the walls is divided into columns two mean outer radii wide, and each is as high as the
/// top of the highest grain whose centre stands in it (heights against gravity, widths across it). Grains that are out
/// do not count. NaN without walls, grains or gravity.
double area_fraction(const Scene& scene, const Grains& grains);

}  // namespace polargrain
