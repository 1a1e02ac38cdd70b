#pragma once

#include "src/core/vec2.h"

namespace polargrain {

/// Area [m^2], centre of mass [m] and second polar moment of area about it [m^4] of an outline.
///
/// Mass per metre of depth is density x area, moment of inertia density x polar_moment.
struct MassProperties {
    double area = 0.0;
    Vec2 centroid = Vec2::Zero();
    double polar_moment = 0.0;
};

}  // namespace polargrain
