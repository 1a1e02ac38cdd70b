#pragma once

#include <optional>

#include "src/model/dem_settings.h"

namespace polargrain {

/// What the table [box2d] of a scenario says; docs/box2d.md explains each.
struct Box2dSettings {
    int velocity_iterations = 8;  ///< passes of the velocity solver in a step
    int position_iterations = 3;  ///< passes of the position solver in a step
    std::optional<double> unit;   ///< [m] that Box2D takes for one of its units; none: chosen from the grains
    double skin = 0.0025;         ///< round every outline [units]; half of the slop, so that outlines at rest touch
    std::optional<double> restitution_threshold;  ///< [m/s] slower impacts do not bounce; none: twice what gravity
                                                  ///< gives in a step
    bool continuous = false;                      ///< stop fast grains at walls that they would pass within a step
};

/// The parameters of all engines; each takes its own.
struct EngineSettings {
    Box2dSettings box2d;
    DemSettings dem;
};

}  // namespace polargrain
