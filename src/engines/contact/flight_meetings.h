#pragma once

#include <span>
#include <vector>

#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/contact_lanes.h"
#include "src/engines/contact/gap_motion.h"
#include "src/engines/contact/pose_set.h"
#include "src/model/scene.h"

namespace polargrain {

struct Flight;
struct OutlineMeeting;

/// Gives the contacts of two grains that fly the normal, the arms and the gap of the moment at which they meet.
///
/// By those of the middle of the step a pair is struck at a wrong place and angle, and so are pairs that pass one
/// another closely. A gap is given such that it closes, at the speed that the contact has, when the grains meet; a
/// point that is beside its edge by then takes no part any more in this step.
class FlightMeetings {
public:
    explicit FlightMeetings(const Scene& scene);

    /// What a step works on. `slow`: closing speed up to which contacts are left to the solver [m/s].
    struct StepInHand {
        std::vector<GapContact>* contacts = nullptr;
        ContactLanes* lanes = nullptr;
        const std::vector<SolverBody>* bodies = nullptr;
        const PoseSet* trial = nullptr;
        const ByGrain* by_grain = nullptr;
        double slow = 0.0;
    };
    void begin(const StepInHand& step) { now_ = step; }

    /// Does nothing press the grain?
    bool flies(GrainIndex grain) const;

    /// Is it the first contact of its pair?
    bool begins_pair(std::size_t contact) const;

    /// Too fast for the solver?
    bool closes_fast(std::size_t contact) const {
        return -normal_speed((*now_.contacts)[contact], *now_.bodies) > now_.slow;
    }

    /// Of a contact of two disks, or the first contact of two polygons that nothing presses and no wall is near; all
    /// others stay as they are. from, to: the times looked at, from the beginning of the sub-step [s].
    void foresee(std::size_t contact, double from, double to) const;
    void foresee_disks(std::size_t contact, double from, double to) const;

private:
    struct Outlines;

    void foresee_polygons(std::size_t first, double from, double to) const;
    std::span<GapContact> pair_of(std::size_t first) const;
    GapContact& contact_of(const OutlineMeeting& meeting, const Outlines& then, std::span<GapContact> pair) const;
    bool is_free(GrainIndex grain) const;
    bool may_meet(const GapContact& c, const Flight& i, const Flight& j, double to) const;
    Flight flight_of(GrainIndex grain) const;
    void turn(GapContact& c, std::size_t contact, const Outlines& then, bool strikes) const;
    double radius(GrainIndex grain) const { return radius_[Grains::at(grain)]; }

    const Scene& scene_;
    std::vector<double> radius_;  ///< of the grains, outer [m]
    StepInHand now_;
};

}  // namespace polargrain
