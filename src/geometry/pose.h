#pragma once

#include "src/core/elementary.h"
#include "src/core/vec2.h"

namespace polargrain {

/// Where a grain is: centre of mass [m] and rotation, kept as sine and cosine of its angle [rad].
struct Pose {
    Vec2 centre = Vec2::Zero();
    double cosine = 1.0;
    double sine = 0.0;

    static Pose at(const Vec2& centre, double angle) {
        const auto [s, c] = sine_cosine(angle);
        return {centre, c, s};
    }

    /// From the grain's own frame to the frame that the pose is given in.
    Vec2 turned(const Vec2& v) const { return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()}; }
    // Number by number: two numbers just written and read back as one vector would have to leave the store buffer
    // first.
    Vec2 to_world(const Vec2& local) const {
        return {centre.x() + (cosine * local.x() - sine * local.y()),
                centre.y() + (sine * local.x() + cosine * local.y())};
    }

    /// Back into the grain's own frame.
    Vec2 turned_back(const Vec2& v) const { return {cosine * v.x() + sine * v.y(), -sine * v.x() + cosine * v.y()}; }
    Vec2 to_local(const Vec2& world) const { return turned_back(world - centre); }

    /// This pose seen from the frame of another: relative.to_world takes my local points into its local frame.
    Pose relative_to(const Pose& other) const {
        return {other.to_local(centre), other.cosine * cosine + other.sine * sine,
                other.cosine * sine - other.sine * cosine};
    }
};

}  // namespace polargrain
