#include <gtest/gtest.h>

#include <map>

#include "src/core/elementary.h"
#include "src/export/outline_cells.h"
#include "tests/record/small_scene.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

constexpr int k_sides = 32;

std::vector<std::vector<std::int32_t>> cells_of(const CellList& list) {
    std::vector<std::vector<std::int32_t>> cells;
    auto from = list.corners.begin();
    for (const std::int32_t end : list.ends) {
        cells.emplace_back(from, list.corners.begin() + end);
        from = list.corners.begin() + end;
    }
    EXPECT_EQ(from, list.corners.end());
    return cells;
}

double area_of(const OutlineCells& cells) {
    double twice = 0.0;
    for (const auto& cell : cells_of(cells.pieces)) {
        for (std::size_t k = 0; k < cell.size(); ++k) {
            twice += cross(cells.points.at(static_cast<std::size_t>(cell[k])),
                           cells.points.at(static_cast<std::size_t>(cell[(k + 1) % cell.size()])));
        }
    }
    return 0.5 * twice;
}

double boundary_of(const OutlineCells& cells) {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& cell : cells_of(cells.pieces)) {
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const auto [a, b] = std::minmax(cell[k], cell[(k + 1) % cell.size()]);
            ++edges[{a, b}];
        }
    }
    double length = 0.0;
    for (const auto& [edge, pieces] : edges) {
        EXPECT_LE(pieces, 2);
        if (pieces == 1) {
            length += (cells.points[static_cast<std::size_t>(edge.first)] -
                       cells.points[static_cast<std::size_t>(edge.second)])
                          .norm();
        }
    }
    return length;
}

bool all_convex(const OutlineCells& cells) {
    for (const auto& cell : cells_of(cells.pieces)) {
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const auto corner = [&](std::size_t n) {
                return cells.points.at(static_cast<std::size_t>(cell[(k + n) % cell.size()]));
            };
            if (cross(Vec2(corner(1) - corner(0)), Vec2(corner(2) - corner(1))) < 0.0) return false;
        }
    }
    return true;
}

double perimeter(const PolarPolygon& outline) {
    double length = 0.0;
    for (int q = 0; q < outline.size(); ++q) length += (outline.vertex(outline.next(q)) - outline.vertex(q)).norm();
    return length;
}

std::vector<std::shared_ptr<const Shape>> polygons() {
    Scene scene = testing::empty_scene(0.5, 0.5);
    testing::add_rectangle(scene, 0.02, 0.01, 12);
    testing::add_star(scene, 0.01, 0.004, 5);
    for (std::uint64_t draw = 1; draw <= 10; ++draw) testing::add_rough(scene, 0.01, 0.3, draw);
    scene.add(std::make_shared<const Shape>(testing::bracket(0.008)));
    for (const std::string& name : testing::shipped_outlines()) {
        for (const auto& shape : testing::pour_outline(name, 1, 1, 1).shapes) scene.add(shape);
    }
    return scene.shapes;
}

TEST(OutlineCells, ConvexPiecesOfAPolygonAreTheWholeOfIt) {
    std::size_t cut = 0;
    for (const auto& shape : polygons()) {
        const auto& outline = std::get<PolarPolygon>(*shape);
        const OutlineCells cells = outline_cells(outline, k_sides);
        EXPECT_TRUE(all_convex(cells)) << outline.name();
        EXPECT_NEAR(area_of(cells), outline.area(), 1e-12 * outline.area()) << outline.name();
        EXPECT_LE(cells.points.size(), static_cast<std::size_t>(outline.size())) << "no point stands twice";
        cut += cells.pieces.size() > 1 ? 1 : 0;
    }
    EXPECT_GE(cut, 10u);
}

TEST(OutlineCells, EdgesOfOnePieceAloneAreTheOutline) {
    for (const auto& shape : polygons()) {
        const auto& outline = std::get<PolarPolygon>(*shape);
        EXPECT_NEAR(boundary_of(outline_cells(outline, k_sides)), perimeter(outline), 1e-12 * perimeter(outline))
            << outline.name();
    }
}

TEST(OutlineCells, AConvexOutlineIsOnePiece) {
    Scene scene;
    testing::add_rectangle(scene, 0.02, 0.01, 12);
    const OutlineCells cells = outline_cells(scene.shape(0), k_sides);
    EXPECT_EQ(cells.pieces.size(), 1u);
    EXPECT_EQ(cells.points.size(), 4u) << "points amid straight sides are left out";
}

TEST(OutlineCells, ADiskIsARegularPolygonOnItsCircle) {
    const Disk disk("ball", 0.01);
    for (const int sides : {3, 32, 100}) {
        const OutlineCells cells = outline_cells(disk, sides);
        ASSERT_EQ(cells.points.size(), static_cast<std::size_t>(sides));
        EXPECT_EQ(cells.pieces.size(), 1u);
        EXPECT_EQ(cells.points[0], Vec2(0.01, 0.0));
        for (const Vec2& point : cells.points) EXPECT_NEAR(point.norm(), 0.01, 1e-17);
        EXPECT_NEAR(area_of(cells), 0.5 * sides * std::sin(2.0 * k_pi / sides) * 1e-4, 1e-18) << "counter-clockwise";
    }
}

}  // namespace
}  // namespace polargrain
