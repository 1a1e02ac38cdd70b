#pragma once

#include <vector>

#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// A straight piece of a wall where it is now; pieces of a chain that go on in a straight line count as one.
struct SoftPiece {
    int wall = 0;
    Vec2 a = Vec2::Zero();
    Vec2 b = Vec2::Zero();
    Vec2 along = Vec2::UnitX();  ///< unit, from a to b
    double length = 0.0;         ///< [m]
    int before = -1;             ///< piece of the same chain that ends at a; -1: a is a free end
    int after = -1;              ///< piece that begins at b; -1: b is a free end
};

/// The pieces of a scene's walls and how the walls move.
class SoftWalls {
public:
    explicit SoftWalls(const Scene& scene);

    /// Brings pieces and motions to a time [s]; does nothing where no wall moves.
    void place(double time);

    /// In descending order of the wall, which is ascending order of its BodyIndex.
    const std::vector<SoftPiece>& pieces() const { return pieces_; }
    bool present(const SoftPiece& piece) const { return present_[static_cast<std::size_t>(piece.wall)] != 0; }
    bool present(BodyIndex wall) const { return present_[static_cast<std::size_t>(wall_index(wall))] != 0; }
    /// Velocity of the wall's material at the world's origin and its spin.
    const Motion& motion(BodyIndex wall) const { return motions_[static_cast<std::size_t>(wall_index(wall))]; }
    /// The same at the time before the present one.
    const Motion& motion_before(BodyIndex wall) const { return before_[static_cast<std::size_t>(wall_index(wall))]; }
    bool any_moves() const { return any_moves_; }

private:
    struct Rest {
        Vec2 a, b;
    };

    void enter(int wall);

    const Scene& scene_;
    bool any_moves_ = false;
    bool placed_ = false;
    std::vector<Rest> rest_;
    std::vector<SoftPiece> pieces_;
    std::vector<char> present_;
    std::vector<Motion> motions_, before_;
};

/// Where a circle touches a piece of a chain, if it does.
struct ChainTouch {
    bool touches = false;
    Vec2 nearest = Vec2::Zero();  ///< point of the piece
};

/// Contact of a circle about `centre` with one piece such that a chain as a whole is met once at each place: a face by
/// its own piece, a corner by the piece that begins there and only where the centre lies beyond both faces' ends.
/// Whether it is near enough is left to the caller.
ChainTouch touch_chain(const std::vector<SoftPiece>& pieces, std::size_t k, const Vec2& centre);

}  // namespace polargrain
