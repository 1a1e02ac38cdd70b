#include "src/detect/wall_pieces.h"

namespace polargrain {

void add_pieces(const Wall& wall, int number, const WallState& state, std::vector<PlacedPiece>& pieces) {
    for (int s = 0; s < wall.segments(); ++s) {
        const auto k = static_cast<std::size_t>(s);
        pieces.push_back({{state.point(wall.points[k]), state.point(wall.points[k + 1])}, number, s});
    }
}

void place_pieces(std::span<const Wall> walls, double time, std::vector<PlacedPiece>& pieces) {
    pieces.clear();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (!walls[w].present(time)) continue;
        add_pieces(walls[w], static_cast<int>(w), wall_state(walls[w], time), pieces);
    }
}

Motion wall_motion(const WallState& state) { return {state.velocity_at(Vec2::Zero()), state.spin}; }

}  // namespace polargrain
