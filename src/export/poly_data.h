#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "src/core/vec2.h"

namespace polargrain {

/// Numbers under a name, some for each point or for each cell.
struct NamedNumbers {
    std::string name;
    std::variant<std::vector<std::int32_t>, std::vector<double>> values;
    int components = 1;  ///< numbers for each point or cell
};

/// Cells, each given by the numbers of its points.
struct CellList {
    std::vector<std::int32_t> corners;  ///< of all cells, one cell after the other
    std::vector<std::int32_t> ends;     ///< for each cell, how many corners there are up to its end

    std::size_t size() const { return ends.size(); }
    /// To be called when the corners of a cell have been put.
    void end_cell() { ends.push_back(static_cast<std::int32_t>(corners.size())); }
};

/// What VTK calls by this name: points, and dots, lines and polygons between them. Numbers that stand with cells come
/// in the order verts, lines, polys.
struct PolyData {
    std::vector<Vec2> points;  ///< [m], in the plane z = 0
    CellList verts, lines, polys;
    std::vector<NamedNumbers> point_data, cell_data;
};

/// With a third component that is zero: VTK knows no vectors of the plane.
NamedNumbers in_space(std::string name, std::span<const Vec2> vectors);

}  // namespace polargrain
