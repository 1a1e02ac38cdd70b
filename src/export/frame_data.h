#pragma once

#include <vector>

#include "render/picture.h"
#include "src/export/outline_cells.h"
#include "src/export/poly_data.h"

namespace polargrain {

// What one instant holds, as PolyData; docs/export.md lists names and units.

/// The grains of one scene, instant by instant, each of its shapes cut only once.
class GrainCells {
public:
    /// disk_sides: as in outline_cells.
    GrainCells(const Scene& scene, int disk_sides);
    /// Polygons, those of a grain one after the other, with the state of the grain at each of them.
    PolyData at(const Picture& picture) const;

private:
    std::vector<OutlineCells> shapes_;  // of the scene, by their index
};

/// A dot for each contact. Forces are the impulses of the last step over time_step [s].
PolyData contact_points(const Picture& picture, double time_step);

/// A line for each wall that is there at that time, where it is then.
PolyData wall_lines(const Picture& picture);

}  // namespace polargrain
