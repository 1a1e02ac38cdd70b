#include "src/export/frame_data.h"

#include <cmath>

namespace polargrain {

namespace {

/// Where the numbers of a grain are to stand: at each of its pieces.
struct GrainPiece {
    GrainIndex grain;
    std::int32_t piece;
};

std::vector<NamedNumbers> grain_data(const Grains& grains, const std::vector<GrainPiece>& pieces) {
    std::vector<std::int32_t> number, piece, shape, material;
    std::vector<double> mass, angle, spin, speed;
    std::vector<Vec2> position, velocity;
    for (const GrainPiece& entry : pieces) {
        const std::size_t at = Grains::at(entry.grain);
        number.push_back(entry.grain);
        piece.push_back(entry.piece);
        shape.push_back(grains.shape[at]);
        material.push_back(grains.material[at]);
        mass.push_back(grains.mass[at]);
        position.push_back(grains.position(entry.grain));
        angle.push_back(grains.angle[at]);
        velocity.push_back(grains.velocity(entry.grain));
        speed.push_back(std::sqrt(velocity.back().squaredNorm()));
        spin.push_back(grains.spin[at]);
    }
    return {{"grain", std::move(number)},      {"piece", std::move(piece)},    {"shape", std::move(shape)},
            {"material", std::move(material)}, {"mass", std::move(mass)},      in_space("position", position),
            {"angle", std::move(angle)},       in_space("velocity", velocity), {"speed", std::move(speed)},
            {"spin", std::move(spin)}};
}

}  // namespace

GrainCells::GrainCells(const Scene& scene, int disk_sides) {
    for (const auto& shape : scene.shapes) shapes_.push_back(outline_cells(*shape, disk_sides));
}

PolyData GrainCells::at(const Picture& picture) const {
    PolyData data;
    std::vector<GrainPiece> pieces;
    for (GrainIndex k = 0; k < picture.grains.size(); ++k) {
        const OutlineCells& cells = shapes_[static_cast<std::size_t>(picture.grains.shape[Grains::at(k)])];
        const Pose pose = picture.grains.pose(k);
        const auto first_point = static_cast<std::int32_t>(data.points.size());
        const auto first_corner = static_cast<std::int32_t>(data.polys.corners.size());
        for (const Vec2& point : cells.points) data.points.push_back(pose.to_world(point));
        for (const std::int32_t corner : cells.pieces.corners) data.polys.corners.push_back(first_point + corner);
        for (std::size_t p = 0; p < cells.pieces.size(); ++p) {
            data.polys.ends.push_back(first_corner + cells.pieces.ends[p]);
            pieces.push_back({k, static_cast<std::int32_t>(p)});
        }
    }
    data.cell_data = grain_data(picture.grains, pieces);
    return data;
}

PolyData contact_points(const Picture& picture, double time_step) {
    PolyData data;
    std::vector<std::int32_t> a, b;
    std::vector<double> gap;
    std::vector<Vec2> normal, impulse, force;
    for (const Contact& contact : picture.contacts) {
        data.verts.corners.push_back(static_cast<std::int32_t>(data.points.size()));
        data.verts.end_cell();
        data.points.push_back(contact.point);
        a.push_back(contact.a);
        b.push_back(contact.b);
        normal.push_back(contact.normal);
        gap.push_back(contact.gap);
        impulse.push_back(contact.impulse);
        force.emplace_back(contact.impulse / time_step);
    }
    data.point_data = {{"a", std::move(a)},     {"b", std::move(b)},          in_space("normal", normal),
                       {"gap", std::move(gap)}, in_space("impulse", impulse), in_space("force", force)};
    return data;
}

PolyData wall_lines(const Picture& picture) {
    PolyData data;
    std::vector<std::int32_t> number, material;
    for (const PlacedWall& wall : picture.walls) {
        for (const Vec2& point : wall.points) {
            data.lines.corners.push_back(static_cast<std::int32_t>(data.points.size()));
            data.points.push_back(point);
        }
        data.lines.end_cell();
        number.push_back(wall.number);
        material.push_back(picture.scene.walls[static_cast<std::size_t>(wall.number)].material);
    }
    data.cell_data = {{"wall", std::move(number)}, {"material", std::move(material)}};
    return data;
}

}  // namespace polargrain
