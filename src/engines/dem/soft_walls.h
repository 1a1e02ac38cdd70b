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

    /// The length of a step of the scheme [s].
    void set_step(double length) { step_ = length; }

    /// Brings pieces and motions to a time [s]; does nothing where no wall moves.
    void place(double time);

    /// In descending order of the wall, which is ascending order of its BodyIndex.
    const std::vector<SoftPiece>& pieces() const { return pieces_; }
    bool present(const SoftPiece& piece) const { return present_[static_cast<std::size_t>(piece.wall)] != 0; }
    bool present(BodyIndex wall) const { return present_[static_cast<std::size_t>(wall_index(wall))] != 0; }
    /// Velocity of the wall's material at the world's origin and its spin. Where the motion starts or ends within the
    /// step before or after, its mean over both: the work of a step is reckoned with the velocities at its two ends.
    const Motion& motion(BodyIndex wall) const { return motions_[static_cast<std::size_t>(wall_index(wall))]; }
    /// The same for the way in the step that ends now, as forces at its end and at its beginning work on it: velocities
    /// at these two times or, where the motion starts or ends meanwhile, the mean.
    const Motion& going(BodyIndex wall) const { return ways_[static_cast<std::size_t>(wall_index(wall))].at_end; }
    const Motion& going_at_first(BodyIndex wall) const {
        return ways_[static_cast<std::size_t>(wall_index(wall))].at_first;
    }
    bool any_moves() const { return any_moves_; }

private:
    struct Rest {
        Vec2 a, b;
    };
    struct Way {
        Motion at_first, at_end;
    };

    void enter(int wall);
    Way way_of(const Wall& wall, const Motion& before, const Motion& now, double time) const;

    const Scene& scene_;
    bool any_moves_ = false;
    bool placed_ = false;
    double step_ = 0.0;
    std::vector<Rest> rest_;
    std::vector<SoftPiece> pieces_;
    std::vector<char> present_;
    std::vector<Motion> now_;  ///< at the present time
    std::vector<Motion> motions_;
    std::vector<Way> ways_;
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
