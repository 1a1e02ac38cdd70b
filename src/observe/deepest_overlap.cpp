#include "src/observe/deepest_overlap.h"

#include <algorithm>
#include <vector>

#include "src/detect/contact_finder.h"
#include "src/detect/neighbours.h"

namespace polargrain {

namespace {

/// A wall piece where it is now.
struct PlacedWallPiece {
    WallPiece piece;
    Vec2 lower, upper;
};

std::vector<PlacedWallPiece> wall_pieces(const Scene& scene, double time) {
    std::vector<PlacedWallPiece> pieces;
    for (const Wall& wall : scene.walls) {
        if (!wall.present(time)) continue;
        const WallState state = wall_state(wall, time);
        for (std::size_t k = 1; k < wall.points.size(); ++k) {
            const Vec2 a = state.point(wall.points[k - 1]);
            const Vec2 b = state.point(wall.points[k]);
            pieces.push_back({{a, b}, a.cwiseMin(b), a.cwiseMax(b)});
        }
    }
    return pieces;
}

double deepest_between_grains(const Scene& scene, const Grains& grains, const std::vector<Pose>& poses) {
    std::vector<BoundingCircle> circles;
    circles.reserve(poses.size());
    for (GrainIndex k = 0; k < grains.size(); ++k)
        circles.push_back({grains.position(k), outer_radius(scene.shape_of(k))});
    NeighbourSearch search;
    std::vector<GrainPair> pairs;
    search.find_pairs(circles, pairs);
    double deepest = 0.0;
    for (const auto& [a, b] : pairs) {
        const Pose& pose_a = poses[Grains::at(a)];
        const Pose& pose_b = poses[Grains::at(b)];
        const auto contact = find_contact({scene.shape_of(a), pose_a, {}}, {scene.shape_of(b), pose_b, {}});
        if (contact) deepest = std::max(deepest, contact->depth);
    }
    return deepest;
}

double deepest_into_walls(const Scene& scene, const Grains& grains, const std::vector<Pose>& poses, double time) {
    const std::vector<PlacedWallPiece> pieces = wall_pieces(scene, time);
    double deepest = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const Shape& shape = scene.shape_of(k);
        const Vec2 centre = grains.position(k);
        const Vec2 reach = Vec2::Constant(outer_radius(shape));
        for (const PlacedWallPiece& wall : pieces) {
            if (((centre + reach - wall.lower).minCoeff() < 0.0) || ((wall.upper - centre + reach).minCoeff() < 0.0)) {
                continue;
            }
            const auto contact = find_contact({shape, poses[Grains::at(k)], {}}, wall.piece, {}, centre);
            if (contact) deepest = std::max(deepest, contact->depth);
        }
    }
    return deepest;
}

}  // namespace

double deepest_overlap(const Scene& scene, const World& world) {
    std::vector<Pose> poses;
    poses.reserve(world.grains.x.size());
    for (GrainIndex k = 0; k < world.grains.size(); ++k) poses.push_back(world.grains.pose(k));
    return std::max(deepest_between_grains(scene, world.grains, poses),
                    deepest_into_walls(scene, world.grains, poses, world.time));
}

OverlapMeter::OverlapMeter(const Scene& scene)
    : scene_(&scene), deepest_(deepest_overlap(scene, initial_world(scene))) {}

void OverlapMeter::step(const World& world, double /*dt*/, const StepReport& /*report*/) {
    if (world.step % k_steps_between == 0) deepest_ = std::max(deepest_, deepest_overlap(*scene_, world));
}

void OverlapMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/deepest", std::vector{deepest_});
}

void OverlapMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    deepest_ = checkpoint.reals(prefix + "/deepest").at(0);
}

}  // namespace polargrain
