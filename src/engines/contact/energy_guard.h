#pragma once

#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/pose_set.h"

namespace polargrain {

/// Kinetic energy of one grain, per metre of depth [J/m].
double kinetic_energy(const SolverBody& body);

/// Kinetic energy plus potential energy at the given poses, per metre of depth [J/m].
double total_energy(const std::vector<SolverBody>& bodies, const PoseSet& poses, const Vec2& gravity,
                    const Parallel& parallel);

/// Takes back what a step has created: where `excess` [J/m] > 0, the velocities of the grains that took part in
/// contacts are scaled so that the total falls by it, as far as their kinetic energy allows. Returns what was taken.
double guard_energy(std::vector<SolverBody>& bodies, double excess);

}  // namespace polargrain
