#pragma once

#include <vector>

#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/contact_lanes.h"
#include "src/engines/contact/footing.h"
#include "src/engines/contact/halfway.h"
#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// The impacts of a sub-step: contacts that close faster than k_impact g dt and would meet within it get Stronge's
/// impulse, fastest first, until none is left.
///
/// Grains that stand on a wall turn about their foot while another grain strikes them, where foot and friction can hold
/// them (Footing); both grains of a pair may.
class GapImpacts {
public:
    static constexpr double k_impact = 3.0;      ///< closing speeds above this many g dt are impacts
    static constexpr int k_most_impacts = 20;    ///< per contact and sub-step
    static constexpr double k_foot_gap = 2.0;    ///< feet rest at most this many resting gaps from the wall
    static constexpr double k_foot_speed = 0.1;  ///< of the closing speed: feet that move faster hold nothing

    static constexpr double k_alone = 8.0;  ///< ways of the closing speed in a sub-step; nothing else may be nearer

    explicit GapImpacts(const Scene& scene) : scene_(scene) {}

    /// What a step works on, for as long as it lasts. `trial` are the poses that its sub-steps move on, `lanes` hold
    /// the gaps, `halfway` is where the contacts have been carried to.
    struct StepInHand {
        std::vector<GapContact>* contacts = nullptr;
        ContactLanes* lanes = nullptr;
        std::vector<SolverBody>* bodies = nullptr;
        PoseSet* trial = nullptr;
        const Halfway* halfway = nullptr;
        StepReport* report = nullptr;
        std::int64_t step = 0;
        double time = 0.0, dt = 0.0;
    };

    void begin(const StepInHand& step);

    /// All contacts that may strike in the first sub-step.
    void find_all_closing(std::vector<std::int32_t>& closing) const;

    /// One sub-step of length h [s]. `closing`: contacts that may strike, in any order; the others are looked at when
    /// an impact has changed them.
    void run(const std::vector<std::int32_t>& closing, double h);

    /// Closing speed up to which contacts are left to the solver [m/s].
    double slow() const { return impact_speed_; }

    /// A contact that closes, in the order in which they are struck.
    struct Strike {
        double speed;
        std::int32_t contact;
        std::int32_t stamp;
    };

private:
    /// A place where a grain may stand on a wall, and how; none if it is free.
    struct Stance {
        GapContact* foot = nullptr;
        Grip grip = Grip::holds;
    };
    struct Blow;

    double open(const GapContact& c) const;
    bool strikes(const GapContact& c, double h, double& speed) const;
    double time_to_wall(const GapContact& c, double speed, double h) const;
    void strike_in_flight(GapContact& c, double speed, double flight);
    void strike(GapContact& c, double speed);
    void add_stances(GrainIndex grain, double speed, std::vector<Stance>& stances) const;
    Blow blow(const GapContact& c, double restitution, const Stance& stance_i, const Stance& stance_j) const;
    static bool presses_another(const Footing& footing, const std::vector<Stance>& stances);
    void take(GapContact& c, const Blow& blow, GapContact* foot_i, GapContact* foot_j) const;
    void push_one(GapContact& c, double normal, double tangential, SlipMode mode, double restitution) const;

    const Scene& scene_;
    StepInHand now_;
    double impact_speed_ = 0.0;
    ByGrain by_grain_;  ///< contacts
    std::vector<Stance> stances_i_, stances_j_;
    std::vector<Strike> heap_;
    std::vector<std::int32_t> stamp_, uses_;
};

}  // namespace polargrain
