#pragma once

#include <vector>

#include "src/model/contact.h"

namespace polargrain {

/// A contact found while the trial configuration was checked, kept for the contact stage of the next step.
struct RecordedContact {
    BodyIndex a = 0, b = 0;  ///< a < b; a may be a wall
    Vec2 point = Vec2::Zero();
    Vec2 normal = Vec2::UnitY();   ///< unit, out of a into b
    Vec2 centre_a = Vec2::Zero();  ///< centres of mass of the poses that were found to overlap; origin for a wall
    Vec2 centre_b = Vec2::Zero();
    double depth = 0.0;  ///< of the trial overlap [m]
};

}  // namespace polargrain
