#include "src/engines/contact/wall_pieces.h"

namespace polargrain {

void place_pieces(const Scene& scene, double time, std::vector<PlacedPiece>& pieces) {
    pieces.clear();
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        if (!wall.present(time)) continue;
        const WallState state = wall_state(wall, time);
        for (std::size_t k = 0; k + 1 < wall.points.size(); ++k) {
            const WallPiece piece{state.point(wall.points[k]), state.point(wall.points[k + 1])};
            const double length = std::sqrt((piece.b - piece.a).squaredNorm());
            pieces.push_back({static_cast<int>(w), wall.moves(), piece, length, (piece.b - piece.a) / length});
        }
    }
}

Motion wall_motion(const Wall& wall, double time) {
    const WallState state = wall_state(wall, time);
    return {state.velocity_at(Vec2::Zero()), state.spin};
}

}  // namespace polargrain
