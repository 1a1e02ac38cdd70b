#pragma once

#include <vector>

#include "src/export/poly_data.h"
#include "src/geometry/shape.h"

namespace polargrain {

/// A shape as polygons that any program fills rightly.
///
/// Many fill a polygon as a fan of triangles from its first point (VTK did for years), which spills over where it is
/// not convex: an outline is therefore cut into convex pieces, few for most shapes. Pieces share their points, so that
/// an edge that belongs to one piece alone is an edge of the outline.
struct OutlineCells {
    std::vector<Vec2> points;  ///< [m] in the grain's own frame
    CellList pieces;           ///< counter-clockwise
};

/// disk_sides: those of the regular polygon that stands for a disk, its corners on the circle, the first on the grain's
/// own x axis.
OutlineCells outline_cells(const Shape& shape, int disk_sides);

}  // namespace polargrain
