#pragma once

#include <functional>
#include <span>

#include "src/engines/box2d/box_world.h"
#include "src/engines/box2d/motion_state.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Fills the report of a step: contacts, forces on walls, and where the energy went.
///
/// Impulses P that act at once change the kinetic energy by the sum of P . (u + u') / 2, u and u' the relative
/// velocities of the contact points at the beginning and the end of the step: each point's share is what it dissipates,
/// split by normal and tangent, and against a moving wall the work of the wall. What the poses have moved beyond dt
/// times the new velocities is Box2D's position correction. What is created is the error of its time stepping,
/// m g dt . (v - v') / 2 a grain, whose sum over steps stays bounded, and rounding. `rises` is all energy beyond the
/// walls' work, so that corrections count, which cost Box2D nothing.
///   before: state at the beginning of the step;  after: at its end
void account(const Scene& scene, const BoxWorld& box, const MotionState& before, const Grains& after, double dt,
             StepReport& report);

}  // namespace polargrain
