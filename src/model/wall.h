#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "src/core/vec2.h"
#include "src/geometry/pose.h"
#include "src/model/materials.h"

namespace polargrain {

/// Shakes along a line: displacement = direction (unit) x amplitude x sin(2 pi frequency (t - start)), from t = start
/// on.
struct SineMotion {
    Vec2 direction = Vec2::UnitY();
    double amplitude = 0.0;  ///< [m]
    double frequency = 0.0;  ///< [Hz]
    double start = 0.0;      ///< [s]
};

/// Turns about a fixed point at a steady rate, from t = start on.
struct RotationMotion {
    Vec2 centre = Vec2::Zero();
    double rate = 0.0;   ///< [rad/s], counter-clockwise +
    double start = 0.0;  ///< [s]
};

/// Moves along at a steady velocity, from t = start on, and rests again, where it has got to, from t = end on.
struct LinearMotion {
    Vec2 velocity = Vec2::Zero();  ///< [m/s]
    double start = 0.0;            ///< [s]
    std::optional<double> end;     ///< [s] none: it never stops
};

using WallMotion = std::variant<std::monostate, SineMotion, RotationMotion, LinearMotion>;

/// An open or closed chain of straight pieces; the free side is on the left of the direction of travel.
struct Wall {
    std::string name;
    MaterialIndex material = 0;
    std::vector<Vec2>
        points;  ///< at rest, i.e. before any motion [m]; a closed chain repeats its first point at the end
    WallMotion motion;
    std::optional<double> remove_at;  ///< [s] gone from this time on

    bool present(double time) const { return !remove_at || time < *remove_at; }
    /// At any time?
    bool moves() const { return !std::holds_alternative<std::monostate>(motion); }
    /// Do the pieces go round something? There and back along one piece does not.
    bool closed() const { return points.size() > 3 && points.front() == points.back(); }
    int segments() const { return static_cast<int>(points.size()) - 1; }
};

/// Rigid motion of a wall at one instant.
struct WallState {
    Pose pose;                     ///< takes rest points to where they are now
    Vec2 velocity = Vec2::Zero();  ///< of the wall's material at `origin` [m/s]
    Vec2 origin = Vec2::Zero();    ///< a point of the plane whose velocity is known [m]
    double spin = 0.0;             ///< [rad/s]

    Vec2 point(const Vec2& rest) const { return pose.to_world(rest); }
    /// Velocity of the wall's material at a point of the plane [m/s].
    Vec2 velocity_at(const Vec2& world) const { return velocity + cross(spin, world - origin); }
};

/// Where the wall is and how fast it moves. For time < motion start it is at rest where its points say, and from the
/// motion's end on at rest where it has got to.
WallState wall_state(const Wall& wall, double time);

/// The same in the middle of an interval [s] of some length [s], with the velocity that takes the wall through it:
/// where the motion starts or ends within, its velocity times the part of the interval in which it moves. (A motion
/// from time zero on, when all begins, has no start.)
WallState wall_state_over(const Wall& wall, double middle, double length);

/// Does the wall move at any moment between two times [s]?
bool moves_between(const Wall& wall, double from, double to);

/// Does its motion start or end in the interval of some length [s] about a middle [s]?
bool starts_or_ends(const Wall& wall, double middle, double length);

/// Where its points are [m] when it rests: before its motion and, where that comes to an end, after it.
std::vector<Vec2> points_at_rest(const Wall& wall);

/// Largest speed that any point of the wall ever has [m/s].
double largest_speed(const Wall& wall);

}  // namespace polargrain
