#pragma once

#include <string>
#include <vector>

#include "src/reproduce/piece.h"

namespace polargrain {

/// One run: an engine, how finely it steps, and from which beginning.
struct EfficiencyRun {
    std::string label;  ///< of the step, for tables
    double time_step_factor = 1.0;
    double target_overlap = 0.0;  ///< of dem; 0: not dem
    int steps_per_contact = 0;    ///< of dem
};

/// A kind of simulation that the paper speaks of, with an observable that its result is judged by.
struct EfficiencyScene {
    std::string name;
    std::string observable;  ///< in summary.json
    std::string quantity;    ///< the same in words
    unsigned beginnings;     ///< how many runs differ in nothing but where they begin
    Piece (*piece)(const std::string& engine, const EfficiencyRun& run, unsigned beginning);
    /// Time step factors by engine, coarse to fine; dem has its ladder of stiffness.
    std::vector<double> (*factors)(const std::string& engine);
};

/// Dominoes, 500 disks poured, rough grains out of a bin. [HN94, secs. 4.1 to 4.3]
const std::vector<EfficiencyScene>& efficiency_scenes();

/// The runs of an engine, coarse to fine: for most, parts of the critical time step [HN94, eq. 6]; for dem, stiffer
/// contacts, which shorten its steps, then more steps in each.
std::vector<EfficiencyRun> efficiency_ladder(const EfficiencyScene& scene, const std::string& engine);

}  // namespace polargrain
