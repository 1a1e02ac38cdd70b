#pragma once

#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/impact_law.h"

namespace polargrain {

/// What a face gets that lands flat: one impact, shared by two contacts of one pair of bodies.
struct FaceBlow {
    ImpactResult result;  ///< of both together
    double of_second =
        0;  ///< share of the impulse that the second contact gets; 0 or 1 where the face tips over an end
};

/// The impact of two bodies that meet in two contacts at once, with all but parallel normals and equal closing speeds.
///
/// One after the other the contacts would throw the bodies into a spin, by an amount that depends on which comes first.
/// Bodies that meet in a face keep their relative spin as long as it presses on both of its ends, and the pressure is
/// where it has to be for that: friction at the face shifts it to the end that runs ahead. So the impact acts at that
/// point between the two contacts, by Stronge's law with the inverse masses of bodies that cannot turn against one
/// another; where there is no such point, at the nearer end, over which the face tips. Derived here.
///
/// The point's motion is a weighted mean of the contacts' own, so that what the law takes is what the two
/// impulses take, to round-off.
FaceBlow solve_face_blow(const GapContact& first, const GapContact& second, const std::vector<SolverBody>& bodies,
                         double restitution);

}  // namespace polargrain
