#pragma once

#include <optional>

#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// A grain on its way with steady velocity and spin.
struct Flight {
    Vec2 centre = Vec2::Zero();    ///< at time zero [m]
    double angle = 0.0;            ///< at time zero [rad]
    Vec2 velocity = Vec2::Zero();  ///< [m/s]
    double spin = 0.0;             ///< [rad/s]

    Pose at(double time) const { return Pose::at(centre + time * velocity, angle + time * spin); }
};

/// Where two outlines first meet: a vertex of one, and the edge of the other that it comes to.
struct OutlineMeeting {
    double time = 0.0;  ///< [s]
    int vertex = 0;
    int edge = 0;
    bool on_i = true;  ///< the vertex belongs to i
};

/// Of two grains that fly, the first time, from <= time <= to [s], at which a vertex of one comes as near as `touching`
/// [m] to an edge of the other; nothing where they pass one another. Gravity may be left out, as it pulls both alike.
///
/// Each vertex is followed, as the other grain sees it, on its chord between times at which neither grain has turned by
/// more than k_meeting_turn since the last: what only its arc reaches, by up to a thousandth of a radius, is passed
/// over.
std::optional<OutlineMeeting> first_meeting(const PolarPolygon& i, const Flight& of_i, const PolarPolygon& j,
                                            const Flight& of_j, double touching, double from, double to);

inline constexpr double k_meeting_turn = 0.1;  ///< [rad]

}  // namespace polargrain
