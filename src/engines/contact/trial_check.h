#pragma once

#include <cstdint>
#include <vector>

#include "src/detect/contact_finder.h"
#include "src/detect/pair_list.h"
#include "src/detect/wall_search.h"
#include "src/engines/contact/motion_update.h"
#include "src/engines/contact/recorded_contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// Where every grain is and where free flight would take it. [HN94, eqs. 47-52]
struct TrialConfiguration {
    std::vector<Pose> current, trial;
    std::vector<double> trial_angle;
};

/// x' = x + v dt + g dt^2 / 2, theta' = theta + w dt; v' = v + g dt goes into the grains at once, as a rejected grain
/// keeps it too.
void take_trial(Grains& grains, const Vec2& gravity, double dt, TrialConfiguration& configuration);

/// Checks a trial configuration: what overlaps, who depends on whom, and through which contacts. [HN94, Fig. 8, 1-2]
class TrialCheck {
public:
    explicit TrialCheck(const Scene& scene);

    /// Velocities of the grains are those after the trial. time, trial_time: at the beginning of the step, and when the
    /// trial poses are reached. `contacts` becomes the contacts of all trial overlaps.
    void run(const TrialConfiguration& configuration, const Grains& grains, double time, double trial_time,
             std::vector<RecordedContact>& contacts);

    const TrialOverlaps& overlaps() const { return overlaps_; }

    /// Completes the contacts for the next step's contact stage, sorted by (a, b): for every rejected grain the grain
    /// that it would have run into is added, where that pair is not there yet.
    void record(const TrialConfiguration& configuration, const Grains& grains, const std::vector<char>& rejected,
                std::vector<RecordedContact>& contacts) const;

private:
    void check_walls(const TrialConfiguration& configuration, const Grains& grains, double time, double trial_time,
                     std::vector<RecordedContact>& contacts);
    void check_pairs(const TrialConfiguration& configuration, const Grains& grains,
                     std::vector<RecordedContact>& contacts);
    bool recedes(const PlacedShape& grain, const ContactGeometry& contact, const Wall& wall, double time,
                 double dt) const;

    const Scene& scene_;
    PairList pairs_;
    WallSearch walls_;
    std::vector<PlacedPiece> pieces_;
    std::vector<std::int32_t> near_;
    std::vector<Motion> wall_motions_;
    TrialOverlaps overlaps_;
};

}  // namespace polargrain
