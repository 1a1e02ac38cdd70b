#include <algorithm>
#include <cmath>

#include "scenarios/grain_groups.h"
#include "src/detect/neighbours.h"
#include "src/detect/overlap.h"

namespace polargrain {

namespace {

const GrainGroup& group_of(const std::vector<GrainGroup>& groups, GrainIndex grain) {
    const auto after = std::upper_bound(groups.begin(), groups.end(), grain,
                                        [](GrainIndex id, const GrainGroup& group) { return id < group.first; });
    return *(after - 1);
}

std::string described(const GrainGroup& group, GrainIndex grain) {
    std::string place = group.path;
    if (group.grains.size() > 1) place += fmt::format(" number {}", grain - group.first);
    if (group.where.line > 0) place += fmt::format(", line {}", group.where.line);
    return fmt::format("grain {} ({})", grain, place);
}

}  // namespace

void check_no_overlap(const Scene& scene, const StartWalls& walls, const std::vector<GrainGroup>& groups) {
    std::vector<BoundingCircle> circles;
    std::vector<Pose> poses;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        circles.push_back({scene.grains.position(k), outer_radius(scene.shape_of(k))});
        poses.push_back(scene.grains.pose(k));
    }
    const auto refuse = [&](GrainIndex grain, const std::string& what) {
        const GrainGroup& group = group_of(groups, grain);
        const Vec2 at = scene.grains.position(grain);
        throw InputError(group.where,
                         fmt::format("{} at ({:.6g}, {:.6g}) m overlaps {} before the first step; move one "
                                     "of them, or make it smaller",
                                     described(group, grain), at.x(), at.y(), what));
    };

    std::vector<GrainPair> pairs;
    NeighbourSearch().find_pairs(circles, pairs);
    for (const auto& [a, b] : pairs) {
        if (overlap(scene.shape_of(a), poses[Grains::at(a)], scene.shape_of(b), poses[Grains::at(b)])) {
            refuse(b, described(group_of(groups, a), a));
        }
    }
    std::optional<std::int32_t> piece;
    GrainIndex first = 0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const auto own = walls.overlapped(scene.shape_of(k), poses[Grains::at(k)]);
        if (!own || (piece && *piece <= *own)) continue;
        piece = own;
        first = k;
    }
    if (!piece) return;
    const PlacedPiece& placed = walls.piece(*piece);
    const Wall& wall = scene.walls[static_cast<std::size_t>(placed.wall)];
    refuse(first, fmt::format("wall \"{}\" (walls[{}], piece {} from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}))", wall.name,
                              placed.wall, placed.segment, placed.piece.a.x(), placed.piece.a.y(), placed.piece.b.x(),
                              placed.piece.b.y()));
}

}  // namespace polargrain
