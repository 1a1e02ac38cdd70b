#include "src/export/outline_cells.h"

#include <limits>
#include <map>
#include <utility>

#include "shapes/convex_pieces.h"
#include "src/core/elementary.h"

namespace polargrain {

namespace {

struct CellMaker {
    int disk_sides;

    OutlineCells operator()(const Disk& disk) const {
        OutlineCells cells;
        for (int k = 0; k < disk_sides; ++k) {
            const auto [sine, cosine] = sine_cosine(2.0 * k_pi * k / disk_sides);
            cells.points.emplace_back(disk.radius() * cosine, disk.radius() * sine);
            cells.pieces.corners.push_back(k);
        }
        cells.pieces.end_cell();
        return cells;
    }

    OutlineCells operator()(const PolarPolygon& outline) const {
        OutlineCells cells;
        std::map<std::pair<double, double>, std::int32_t> numbers;
        for (const ConvexPiece& piece : convex_pieces(outline, std::numeric_limits<int>::max())) {
            for (const Vec2& corner : piece) {
                const auto next = static_cast<std::int32_t>(cells.points.size());
                const auto [known, added] = numbers.try_emplace({corner.x(), corner.y()}, next);
                if (added) cells.points.push_back(corner);
                cells.pieces.corners.push_back(known->second);
            }
            cells.pieces.end_cell();
        }
        return cells;
    }
};

}  // namespace

OutlineCells outline_cells(const Shape& shape, int disk_sides) { return std::visit(CellMaker{disk_sides}, shape); }

}  // namespace polargrain
