#pragma once

#include <cstdint>
#include <vector>

#include "src/core/parallel.h"
#include "src/engines/contact/blow.h"
#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/contact_lanes.h"
#include "src/engines/contact/flight_meetings.h"
#include "src/engines/contact/halfway.h"
#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// The impacts of a sub-step: contacts that close faster than k_impact g dt and would meet within it get Stronge's
/// impulse, until none is left.
///
/// Of all contacts of a grain the one that closes fastest is struck first: a contact gets its turn when no other of its
/// two grains closes faster. Those whose turn it is share no grain, so that they can be struck at the same time: a
/// round. Then the contacts of the grains struck are looked at again, and the next round begins. Rounds follow from
/// the speeds alone, so that any number of threads gives the same bits.
///
/// Two grains that fly (FlightMeetings), or a grain and a wall at rest, that nobody else disturbs in the sub-step
/// strike at the moment at which they meet, between two free flights; all others at its beginning, or when one of the
/// two has last been struck.
class GapImpacts {
public:
    static constexpr double k_impact = 3.0;     ///< closing speeds above this many g dt are impacts
    static constexpr double k_no_speed = 1e-9;  ///< of the bodies' own: plastic impacts leave less to be done
    static constexpr int k_most_impacts = 20;   ///< per contact and sub-step
    static constexpr double k_alone = 8.0;      ///< ways of a sub-step; at a wall nothing else may be nearer

    explicit GapImpacts(const Scene& scene);

    /// What a step works on, for as long as it lasts. `trial` are the poses that its sub-steps move on, `lanes` hold
    /// the gaps, `halfway` is where the contacts have been carried to.
    struct StepInHand {
        std::vector<GapContact>* contacts = nullptr;
        ContactLanes* lanes = nullptr;
        std::vector<SolverBody>* bodies = nullptr;
        PoseSet* trial = nullptr;
        const Halfway* halfway = nullptr;
        const ByGrain* by_grain = nullptr;  ///< the contacts
        StepReport* report = nullptr;
        std::int64_t step = 0;
        double time = 0.0, dt = 0.0;
    };

    void begin(const StepInHand& step);

    /// All contacts that may strike in the first sub-step.
    void find_all_closing(std::vector<std::int32_t>& closing);

    /// One sub-step of length h [s]. `closing`: contacts that may strike, in any order that does not depend on the
    /// number of threads; the others are looked at when an impact has changed them.
    void run(const std::vector<std::int32_t>& closing, double h);

    /// Closing speed up to which contacts are left to the solver [m/s].
    double slow() const { return impact_speed_; }

private:
    /// A contact that closes.
    struct Strike {
        double speed;
        std::int32_t contact;
        BodyIndex i, j;  ///< of the contact
    };
    /// A strike whose turn it is, and when in the sub-step the bodies meet [s].
    struct Turn {
        Strike strike;
        double time;
        Motion i_before{}, j_before{};
    };
    /// What happens to a grain: the fastest of its strikes in a round, and whether all are with one partner; the last
    /// round in which it was struck, and when in the sub-step that was [s].
    struct OfGrain {
        std::int64_t round = 0;
        BodyIndex partner = 0;
        bool one_partner = true;
        Strike fastest{};
        std::int64_t struck = 0;
        double time = 0.0;
    };

    double fastest_of(const GapContact& c) const;
    void look_at(std::int32_t contact, double h, std::vector<Strike>& found) const;
    void find_strikes(const std::vector<std::int32_t>& candidates, double h);
    void look_about(const Turn& turn, double h, std::vector<Strike>& found) const;
    std::size_t begin_looks(std::size_t count, std::size_t length);
    void add_strikes(std::size_t runs);
    void choose_turns(double h);
    bool is_fastest_of(BodyIndex body, const Strike& strike) const;
    bool is_struck(BodyIndex body) const {
        return !is_wall(body) && grains_[static_cast<std::size_t>(body)].struck == round_;
    }
    std::size_t turns_a_run() const;
    void strike_all(double h);
    void strike(std::size_t turn, double h);
    void push_by(std::size_t turn, std::size_t push);
    void lead_back(const Turn& turn);
    void shift(BodyIndex body, const Motion& before, double time) const;
    double struck_at(BodyIndex body) const;
    double earliest(std::int32_t contact) const;
    double time_of(const Strike& strike, double h) const;
    double time_to_wall(const Strike& strike, double h) const;
    ImpactRecord record(const BlowPush& push) const;
    void book();
    void look_again(double h);

    const Scene& scene_;
    Parallel parallel_;
    BlowSolver blow_solver_;
    FlightMeetings meetings_;
    StepInHand now_;
    double impact_speed_ = 0.0;
    std::int64_t round_ = 0;
    std::int64_t first_round_ = 0;  ///< of the sub-step
    double left_ = 0.0;             ///< of the step, from the beginning of the sub-step [s]
    std::vector<Strike> strikes_;
    std::vector<Turn> turns_;
    std::vector<OfGrain> grains_;
    std::vector<std::int64_t> added_;         ///< per contact: the last round that it was added to
    std::vector<std::vector<Strike>> found_;  ///< by runs of what is looked at
    std::vector<std::int32_t> uses_;
    std::vector<Blow> blows_;  ///< of the turns
    std::vector<ImpactRecord> records_;
};

}  // namespace polargrain
