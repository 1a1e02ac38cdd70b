#pragma once

#include <span>
#include <vector>

#include "src/engines/contact/gap_contact.h"

namespace polargrain {

/// A bed at rest, on walls at rest, in a sub-step before any contact has pushed.
struct RestingBed {
    std::span<const GapContact> contacts;
    std::span<const double> open;        ///< of each contact: gap less resting gap [m]
    std::span<const SolverBody> grains;  ///< their inverse masses and inertias
    std::span<const double> reach;       ///< their outer radii [m]
    Vec2 kick = Vec2::Zero();            ///< velocity that gravity gives in the sub-step [m/s]
    double length = 0.0;                 ///< of the sub-step [s]
};

/// Impulses of all lasting contacts of a sub-step, found together, where sweeps over them one by one do not settle.
///
/// Of all velocities v for which no gap closes beyond its resting gap, a bed takes those with the least
/// sum (v - w).M (v - w) / 2, where w is gravity's kick (Gauss's principle of least constraint). The impulses are the
/// multipliers of the gaps. They are found by a primal-dual interior point method [M92]. Its matrix,
/// M + J^T diag(impulse / slack) J, is positive definite although a bed has more contacts than it needs, and of all
/// forces that hold the bed it finds moderate ones.
///
/// A contact with friction pushes along both edges of its cone in place of its normal. What slides would then open its
/// gap, so where grains move on contacts with friction there is no answer. Nor is there one of forces that far
/// exceed the weight of all grains: they hold rows that are all but flat, and change much with the least motion.
///
/// Impulses on the first bodies of contacts, (normal, tangential) [N s/m], go into `impulses`. Returns whether they
/// were found.
bool find_equilibrium(const RestingBed& bed, std::vector<Vec2>& impulses);

}  // namespace polargrain
