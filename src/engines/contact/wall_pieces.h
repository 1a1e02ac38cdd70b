#pragma once

#include <vector>

#include "src/detect/overlap.h"
#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// A piece of a wall that is there at one instant.
struct PlacedPiece {
    int wall = 0;
    bool moves = false;
    WallPiece piece;
    double length = 0.0;         ///< [m]
    Vec2 along = Vec2::UnitX();  ///< unit, from a to b

    /// Can a circle reach it?
    bool near(const Vec2& centre, double radius) const {
        const Vec2 from = centre - piece.a;
        if (std::abs(along.x() * from.y() - along.y() * from.x()) >= radius) return false;
        const double station = along.dot(from);
        return station > -radius && station < length + radius;
    }
};

/// All pieces of the walls present at a time, in order of wall and piece.
void place_pieces(const Scene& scene, double time, std::vector<PlacedPiece>& pieces);

/// Motion of a wall's material at a time, as the velocity of the point of it at the world's origin and its spin.
Motion wall_motion(const Wall& wall, double time);

}  // namespace polargrain
