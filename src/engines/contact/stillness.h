#pragma once

#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Tells when a step would do nothing at all, so that it need not be done: not nearly nothing, but not a single bit.
///
/// Poses, velocities and impulses of a step follow from those before it, the walls and the step's length. Where a step
/// has left every bit as it was, without an impact (whose restitution may be drawn anew), and no wall moves, comes or
/// goes, the next one does the same, and reports the same.
class Stillness {
public:
    /// Before a step: is it known to do nothing? Then `report` is what it would report.
    bool holds(const Scene& scene, const World& world, double dt, StepReport& report) const;

    /// Before a step that is done: what it starts from.
    void remember(const World& world, const std::vector<GapContact>& contacts, int careful, double opening_left);

    /// After it: has it changed anything? dt: its length; `time` when it began.
    void judge(const Scene& scene, const World& world, const std::vector<GapContact>& contacts, int careful,
               double opening_left, double time, double dt, const StepReport& report);

    /// Forgets: the state has come from elsewhere.
    void forget() { still_ = unmoved_ = false; }

private:
    bool same_grains(const World& world) const;

    bool still_ = false, unmoved_ = false;
    bool watched_ = false;  ///< the contacts before the step were kept
    double dt_ = 0.0;
    std::vector<double> grains_;  ///< x, y, angle, velocity, spin of all
    std::vector<GapContact> contacts_;
    int careful_ = 0;
    double opening_left_ = 0.0;
    StepReport report_;
};

}  // namespace polargrain
