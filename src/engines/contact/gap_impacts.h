#pragma once

#include <vector>

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

    /// For the step that follows; `halfway` is where the contacts have been carried to, and must outlive it.
    void begin(const std::vector<GapContact>& contacts, const Halfway& halfway, std::int64_t step, double time,
               double dt);

    /// `trial` are the poses that the sub-step moves on.
    void run(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, PoseSet& trial, double h,
             StepReport& report);

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

    void index_by_grain(const std::vector<GapContact>& contacts);
    bool strikes(const GapContact& c, const std::vector<SolverBody>& bodies, double h, double& speed) const;
    double time_to_wall(const GapContact& c, double speed, const std::vector<GapContact>& contacts, double h) const;
    void strike_in_flight(GapContact& c, double speed, double flight, std::vector<GapContact>& contacts,
                          std::vector<SolverBody>& bodies, PoseSet& trial, StepReport& report);
    void strike(GapContact& c, double speed, std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies,
                StepReport& report);
    void add_stances(BodyIndex grain, double speed, std::vector<GapContact>& contacts,
                     const std::vector<SolverBody>& bodies, std::vector<Stance>& stances) const;
    Blow blow(const GapContact& c, const std::vector<SolverBody>& bodies, const Stance& stance_i,
              const Stance& stance_j) const;
    static bool presses_another(const Footing& footing, const std::vector<Stance>& stances);
    void take(GapContact& c, const Blow& blow, GapContact* foot_i, GapContact* foot_j, std::vector<SolverBody>& bodies,
              StepReport& report) const;
    void push_one(GapContact& c, double normal, double tangential, SlipMode mode, std::vector<SolverBody>& bodies,
                  StepReport& report) const;

    const Scene& scene_;
    const Halfway* halfway_ = nullptr;
    double impact_speed_ = 0.0;
    double time_ = 0.0;
    std::int64_t step_ = 0;
    std::vector<std::int32_t> first_of_grain_, fill_, of_grain_;
    std::vector<Stance> stances_i_, stances_j_;
    std::vector<Strike> heap_;
    std::vector<std::int32_t> stamp_, uses_;
};

}  // namespace polargrain
