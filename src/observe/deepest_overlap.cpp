#include "src/observe/deepest_overlap.h"

#include <algorithm>
#include <vector>

#include "src/detect/contact_finder.h"
#include "src/detect/neighbours.h"
#include "src/detect/wall_search.h"

namespace polargrain {

namespace {

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
    std::vector<PlacedPiece> pieces;
    place_pieces(scene.walls, time, pieces);
    WallSearch walls;
    walls.place(pieces);
    double deepest = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const PlacedShape grain{scene.shape_of(k), poses[Grains::at(k)], {}};
        const Vec2 centre = grains.position(k);
        walls.any_near(centre, outer_radius(grain.shape), [&](std::int32_t number) {
            const auto contact = find_contact(grain, pieces[static_cast<std::size_t>(number)].piece, {}, centre);
            if (contact) deepest = std::max(deepest, contact->depth);
            return false;
        });
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
