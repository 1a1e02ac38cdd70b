#include "render/picture.h"

namespace polargrain {

namespace {

PlacedWall placed(const Wall& wall, const Pose& pose, std::size_t number) {
    PlacedWall result{{}, pose, static_cast<int>(number)};
    for (const Vec2& rest : wall.points) result.points.push_back(pose.to_world(rest));
    return result;
}

}  // namespace

Picture picture_of(const Scene& scene, const World& world, const StepReport& report) {
    Picture picture{world.time, scene, world.grains, {}, report.contacts};
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        if (wall.present(world.time)) picture.walls.push_back(placed(wall, wall_state(wall, world.time).pose, w));
    }
    return picture;
}

Picture picture_of(const Scene& scene, const StoredFrame& frame) {
    Picture picture{frame.world.time, scene, frame.world.grains, {}, frame.contacts};
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        if (wall.present(frame.world.time)) picture.walls.push_back(placed(wall, frame.wall_poses[w], w));
    }
    return picture;
}

}  // namespace polargrain
