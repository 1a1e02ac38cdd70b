#pragma once

#include <algorithm>
#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/contact_lanes.h"
#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_opening.h"

namespace polargrain {

/// Moves trial poses apart a little where predicted gaps have become too small; velocities are not touched.
///
/// A unilateral, frictionless projected Gauss-Seidel on displacements, weighted by mass and inertia: gaps below
/// their trigger are opened by k_part of what they lack; others may close to k_trigger of the resting gap, no farther.
/// Pairs at rest have a lower trigger: they lose no gap, and lifting them would only let them fall again. What it lifts
/// costs energy: the whole correction is scaled so that the potential energy it adds does not exceed `budget`, what the
/// step has dissipated.
class PositionCorrection {
public:
    static constexpr double k_trigger = 0.7;       ///< resting gaps, for pairs that move
    static constexpr double k_still = 0.2;         ///< the same for pairs that do not
    static constexpr double k_still_smooth = 0.5;  ///< the same where there is no friction either
    static constexpr double k_stir = 0.1;          ///< resting gaps a step: what counts as moving
    static constexpr double k_part = 0.3;
    static constexpr double k_look = 1.5;  ///< gaps beyond this many resting gaps take no part
    static constexpr int k_sweeps = 6;

    /// How fast gaps may get lost.
    struct Pace {
        double dt;     ///< [s]
        double still;  ///< trigger, in resting gaps, for pairs that do not move past one another
    };

    explicit PositionCorrection(const Scene& scene) : parallel_(std::max(1, scene.threads)) {}

    /// Is any gap below its trigger? Pairs that move by k_stir of the resting gap in a step need k_trigger.
    bool needed(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies, const Pace& pace) const;

    /// `lanes`: the groups that the contacts are taken in, each in the order in which they were found: from below it
    /// carries farther in a pass than an order in colours. budget [J/m] >= 0. Returns the potential energy added [J/m].
    double correct(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies, const Vec2& gravity,
                   const Pace& pace, double budget, const ContactLanes& lanes, PoseSet& trial);

private:
    static constexpr std::size_t k_run = 1024;  ///< grains or contacts that a thread takes at a time

    static bool too_near(const GapContact& c, const std::vector<SolverBody>& bodies, const Pace& pace);
    void collect_rows(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies, const Pace& pace,
                      const ContactLanes& lanes);
    void relax(std::size_t group, bool backwards);
    void hold_back();

    Parallel parallel_;
    std::vector<char> takes_part_;        ///< per contact
    std::vector<std::int32_t> in_order_;  ///< contacts that take part, by groups
    std::vector<std::size_t> end_;        ///< of the rows of a group
    std::vector<GapOpening> rows_;
    std::vector<Shift> shift_;
};

}  // namespace polargrain
