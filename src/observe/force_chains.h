#pragma once

#include <span>
#include <vector>

#include "src/model/contact.h"
#include "src/model/grains.h"

namespace polargrain {

/// The force chains of an instant.
struct ForceChains {
    std::vector<std::vector<GrainIndex>> chains;  ///< members in rising order; sorted by their first
    double force_share = 0.0;  ///< of all normal force between grains, what contacts within chains carry

    double mean_length() const;  ///< grains; NaN without chains
};

/// Force chains after [P05]: a grain is highly stressed where the larger principal value of its own stress (force times
/// arm, summed over its contacts with grains and walls) exceeds the mean over all grains with contacts. Two touching
/// grains of that kind are linked where the way from either to the other lies within 45 degrees of both their
/// directions of greatest compression; three grains or more that hang together make a chain. The original follows
/// single lines of grains; here a branching line is one chain. Impulses of one step stand for forces.
ForceChains find_force_chains(const Grains& grains, std::span<const Contact> contacts);

}  // namespace polargrain
