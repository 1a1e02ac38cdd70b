#pragma once

#include <optional>
#include <vector>

#include "src/model/observable_spec.h"
#include "src/model/scene.h"

namespace polargrain {

/// Unit vector against gravity; upwards (y) without gravity.
Vec2 upwards(const Scene& scene);

/// Height of the lowest wall point at time zero [m], heights counted from the origin against gravity.
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

/// The free surface of a bed: the width of the walls in columns about two mean outer radii wide, each as high as the
/// top (centre plus outer radius) of the highest grain whose centre stands in it.
struct BedSurface {
    double left = 0.0;            ///< of the first column, across gravity [m]
    double width = 0.0;           ///< of a column [m]
    std::vector<double> heights;  ///< above the lowest wall point [m]; zero: an empty column
    double filled = 0.0;          ///< area of the grains that stand in the columns [m^2]

    double area_under() const;  ///< [m^2]
    double station(std::size_t column) const { return left + (static_cast<double>(column) + 0.5) * width; }
};

/// None without walls, grains or gravity. Grains below the lowest wall point do not count.
std::optional<BedSurface> bed_surface(const Scene& scene, const Grains& grains);

/// Area of the grains over the area under their surface. [HN94, sec. 4.2] NaN without walls, grains or gravity.
double area_fraction(const Scene& scene, const Grains& grains);

/// Potential energy of the grains above the lowest wall point over the least that as many equal disks can have between
/// the same walls: rows of a hexagonal packing, of disks with the grains' mean mass and mean area. [HN94, sec. 4.2,
/// Fig. 14] NaN without walls, grains or gravity, or where the walls are narrower than a disk.
double potential_over_hexagonal(const Scene& scene, const Grains& grains);

/// Slope of the free surface against the horizontal [rad], positive where it rises along right_normal(upwards): a
/// straight line of least squares through the tops of the columns, without the outer fifth of them on either side;
/// with a region, through all columns whose middle lies in it (across gravity). NaN with fewer than three columns.
double surface_slope(const Scene& scene, const Grains& grains, const std::optional<Region>& region);

}  // namespace polargrain
