#include "src/engines/contact/contact_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "src/engines/contact/contact_checkpoint.h"
#include "src/engines/contact/contact_report.h"
#include "src/engines/contact/energy_guard.h"
#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_solver.h"
#include "src/engines/contact/position_correction.h"
#include "src/engines/contact/rejection.h"
#include "src/engines/contact/repair.h"
#include "src/engines/contact/step_memory.h"
#include "src/engines/contact/stillness.h"

namespace polargrain {

namespace {

class ContactEngine final : public Engine {
public:
    explicit ContactEngine(const Scene& scene)
        : scene_(scene),
          parallel_(std::max(1, scene.threads)),
          detection_(scene),
          solver_(scene),
          correction_(scene),
          repair_(scene),
          rejection_(scene) {
        const double g = std::sqrt(scene.gravity.squaredNorm());
        for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
            opening_unit_ += g * scene.grains.mass[Grains::at(k)] * detection_.resting_gap(k, wall_body(0));
        }
        opening_left_ = k_opening_in_all * opening_unit_;
    }

    std::string_view name() const override { return "contact"; }
    double suggested_dt() const override { return critical_time_step(scene_); }

    void step(World& world, double dt, StepReport& report) override {
        if (!stillness_.holds(scene_, world, dt, report)) {
            report.clear(scene_.walls.size());
            take_state(world);
            if (!detected_) open_gaps(world.time, dt, report);
            stillness_.remember(world, contacts_, careful_, opening_left_);
            advance(world.step, world.time, dt, 0, report);
            give_state(world, report);
            stillness_.judge(scene_, world, contacts_, careful_, opening_left_, world.time, dt, report);
        }
        ++world.step;
        world.time = static_cast<double>(world.step) * dt;
    }

    void save(Checkpoint& checkpoint) const override;
    void load(const Checkpoint& checkpoint) override;

private:
    static constexpr double k_opening = 0.02;         ///< of the resting gap a grain, in one step
    static constexpr double k_opening_in_all = 10.0;  ///< the same for the whole run
    static constexpr double k_spending = 0.5;  ///< of what a step has dissipated; the whole would go round for ever
    static constexpr int k_opening_passes = 60;
    static constexpr int k_careful_steps = 10;
    static constexpr double k_careful_share = 0.01;
    static constexpr int k_most_halvings = 5;
    static constexpr double k_settling = 12.0;  ///< times the speed of the slowest impact: a bed below it is slow
    // A bed that sweeps do not bring to rest is solved as a whole every so many steps, which costs about as much as
    // a third of the steps between: they are more where there are more contacts, as that costs more than they do.
    static constexpr std::int64_t k_steps_alone = 32;
    static constexpr std::int64_t k_share = 32;
    static constexpr std::int64_t k_left_to_sweeps = 4;
    static constexpr std::size_t k_most_creeping = 8192;  ///< contacts: what a solve costs grows faster than they do
    static constexpr std::size_t k_run = 1024;            ///< grains or contacts that a thread takes at a time

    /// One step, or a part of one: where repair leaves an overlap, everything is taken back and done again in two
    /// halves, as what it could not foresee grows with the square of dt. Only parts of dt / 2^k_most_halvings reject.
    void advance(std::int64_t step, double time, double dt, int halvings, StepReport& report) {
        forget_removed_walls(time);
        memory_.keep(bodies_, contacts_, report);
        const double opening_before = opening_left_;
        const double energy_before = energy_at(before_);
        granted_ = 0.0;
        trial_.centre = before_.centre;
        trial_.angle = before_.angle;
        solver_.advance(contacts_, bodies_, before_, trial_, step, time, dt, effort(halvings, step), report);
        correct_positions(energy_before, dt, report);
        follow_creep();
        refresh_trial();
        detection_.detect(before_, trial_, bodies_, time, time + dt, dt);
        repair(dt, report);
        if (overlapping_ > 0 && halvings < k_most_halvings) {
            memory_.take_back(bodies_, contacts_, report);
            opening_left_ = opening_before;
            // First guesses are impulses of a sub-step: of the same force, a shorter one takes less. A bed at rest that
            // had halved its steps once would otherwise begin each full step with a fraction of its forces, sink,
            // overlap, and halve again. (In a collapse forces do not last, and larger guesses only make grains
            // overlap.)
            const double part = settling(dt) ? 0.5 : 1.0;
            scale_impulses(contacts_, part);
            advance(step, time, 0.5 * dt, halvings + 1, report);
            advance(step, time + 0.5 * dt, 0.5 * dt, halvings + 1, report);
            scale_impulses(contacts_, 1.0 / part);
            return;
        }
        reject(report);
        guard(energy_before, report);
        report_contacts(contacts_, parallel_, report);
        hand_over_contacts();
        std::swap(before_, trial_);
    }

    /// The deepest overlap of some contacts [m].
    struct Deepest {
        double overlap = 0.0;
        Deepest& operator+=(const Deepest& more) {
            overlap = std::max(overlap, more.overlap);
            return *this;
        }
    };

    /// Is the bed slow, in the mean? Then its forces last from step to step.
    bool settling(double dt) const {
        const double slow = k_settling * GapImpacts::k_impact * dt;
        double kinetic = 0.0;
        double most = 0.0;
        for (const SolverBody& body : bodies_) {
            kinetic += kinetic_energy(body);
            most += 0.5 * slow * slow * scene_.gravity.squaredNorm() / body.inverse_mass;
        }
        return kinetic < most;
    }

    /// Parts of a failed step are solved twice as hard with every halving: rows that press against walls need it.
    StepEffort effort(int halvings, std::int64_t step) const {
        if (creeping_) return GapSolver::k_creeping;
        if (halvings > 0) {
            StepEffort harder = GapSolver::k_usual;
            harder.sweeps.sweeps <<= halvings;
            return harder;
        }
        if (careful_ > 0) return GapSolver::k_careful;
        if (!at_rest_) return GapSolver::k_usual;
        StepEffort resting = GapSolver::k_at_rest;
        resting.together = step % std::max(k_steps_alone, static_cast<std::int64_t>(contacts_.size()) / k_share) == 0;
        return resting;
    }

    /// A bed at rest that its forces do not hold sets out. The first few times it is left to the sweeps: mostly they
    /// bring it to rest in the end, for less. After that it is followed until it is held or fast.
    void follow_creep() {
        if (at_rest_ && solver_.creeps()) ++times_set_out_;
        creeping_ = solver_.creeps() && times_set_out_ > k_left_to_sweeps && contacts_.size() <= k_most_creeping;
    }

    void take_state(const World& world) {
        const std::size_t n = world.grains.x.size();
        bodies_.resize(n);
        before_.resize(n);
        trial_.resize(n);
        parallel_.runs(n, k_run, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) {
                const auto g = static_cast<GrainIndex>(k);
                bodies_[k] = {world.grains.velocity(g), world.grains.spin[k], 1.0 / world.grains.mass[k],
                              1.0 / world.grains.inertia[k], false};
                const Vec2 centre = world.grains.position(g);
                const double angle = world.grains.angle[k];
                if (before_.centre[k] == centre && before_.angle[k] == angle && detected_) continue;
                before_.centre[k] = centre;
                before_.angle[k] = angle;
                before_.refresh(k);
            }
        });
        at_rest_ = std::all_of(bodies_.begin(), bodies_.end(), [](const SolverBody& body) {
            return body.velocity == Vec2::Zero() && body.spin == 0.0;
        });
    }

    /// Before the first step: bodies that the scene lets touch are moved apart to their resting gaps, so that they need
    /// not be pushed apart while they move. The energy this takes stands in the ledger as correction.
    void open_gaps(double time, double dt, StepReport& report) {
        const double energy_touching = energy_at(before_);
        const auto detect = [&] {
            detection_.detect(before_, trial_, bodies_, time, time, dt);
            hand_over_contacts();
        };
        trial_ = before_;
        detect();
        if (detection_.overlapping() == 0) detection_.begin_clean();
        const PositionCorrection::Pace pace{dt, PositionCorrection::k_trigger};
        for (int pass = 0; pass < k_opening_passes && correction_.needed(contacts_, bodies_, pace); ++pass) {
            solver_.prepare_at_rest(contacts_, bodies_, trial_);
            correction_.correct(contacts_, bodies_, scene_.gravity, pace, std::numeric_limits<double>::infinity(),
                                solver_.lanes(), trial_);
            refresh_trial();
            detect();
        }
        if (repair_.run(detection_, bodies_, before_, trial_, Repair::k_sweeps) == 0) before_ = trial_;
        trial_ = before_;
        detect();
        detected_ = true;
        report.ledger.correction += energy_at(before_) - energy_touching;
    }

    /// The contacts of a wall that is gone stay in the array, as pairs refer to it, but out of everybody's reach.
    void forget_removed_walls(double time) {
        constexpr double k_out_of_reach = 1e9;
        for (std::size_t k = first_with_wall(contacts_); k < contacts_.size(); ++k) {
            GapContact& c = contacts_[k];
            if (scene_.walls[static_cast<std::size_t>(wall_index(c.j))].present(time)) continue;
            c.gap = k_out_of_reach;
            c.normal_impulse = 0.0;
            c.tangent_impulse = 0.0;
        }
    }

    double energy_at(const PoseSet& poses) const { return total_energy(bodies_, poses, scene_.gravity, parallel_); }
    double wall_work(const StepReport& report) const { return report.ledger.wall_work - memory_.ledger().wall_work; }

    /// The correction may spend half of what the step has dissipated, and a little of its own, which comes to an end:
    /// bodies that start without any gap between them could otherwise never get their resting gaps. That little is
    /// granted to the guard and stands in the ledger as correction.
    void correct_positions(double energy_before, double dt, StepReport& report) {
        if (at_rest_ || creeping_) return;  // no gap gets lost there, and what is lifted only falls again
        const double dissipated = std::max(0.0, energy_before + wall_work(report) - energy_at(trial_));
        const double grant = std::min(k_opening * opening_unit_, opening_left_);
        const double lift = correction_.correct(contacts_, bodies_, scene_.gravity, {dt, PositionCorrection::k_still},
                                                k_spending * dissipated + grant, solver_.lanes(), trial_);
        report.ledger.correction += lift;
        granted_ = std::max(0.0, lift - dissipated);
        opening_left_ = std::max(0.0, opening_left_ - granted_);
    }

    void refresh_trial() {
        parallel_.runs(trial_.pose.size(), k_run, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) trial_.refresh(k);
        });
    }

    /// Many overlapping pairs mean that the solver has not kept up: it works harder for the next steps.
    void repair(double dt, StepReport& report) {
        const int overlapping = detection_.overlapping();
        if (careful_ > 0) --careful_;
        if (static_cast<double>(overlapping) > k_careful_share * static_cast<double>(bodies_.size())) {
            careful_ = k_careful_steps;
        }
        overlapping_ = 0;
        repair_lift_ = 0.0;
        if (overlapping == 0) return;
        const double before = energy_at(trial_);
        const int sweeps = settling(dt) ? Repair::k_few_sweeps : Repair::k_sweeps;
        overlapping_ = repair_.run(detection_, bodies_, before_, trial_, sweeps);
        repair_lift_ = std::max(0.0, energy_at(trial_) - before);
        report.ledger.correction += repair_lift_;
    }

    void reject(StepReport& report) {
        report.moves.tried += static_cast<std::int64_t>(bodies_.size());
        if (overlapping_ > 0) report.moves.rejected += rejection_.run(detection_, before_, trial_, bodies_);
    }

    void guard(double energy_before, StepReport& report) {
        EnergyLedger& ledger = report.ledger;
        const EnergyLedger& was = memory_.ledger();
        const double allowed = energy_before + wall_work(report) + granted_;
        double now = energy_at(trial_);
        now -= guard_energy(bodies_, now - allowed);
        ledger.rises += std::max(0.0, now - allowed - repair_lift_);
        ledger.created += now - energy_before - wall_work(report) + (ledger.restitution_loss - was.restitution_loss) +
                          (ledger.friction_loss - was.friction_loss) - (ledger.correction - was.correction);
    }

    /// The points found at the new poses become the contacts of the next step, with the old impulses as first guesses.
    void hand_over_contacts() { detection_.hand_over(pairs_, contacts_); }

    void give_state(World& world, StepReport& report) {
        parallel_.runs(bodies_.size(), k_run, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) {
                const auto g = static_cast<GrainIndex>(k);
                world.grains.set_position(g, before_.centre[k]);
                world.grains.angle[k] = before_.angle[k];
                world.grains.set_velocity(g, bodies_[k].velocity);
                world.grains.spin[k] = bodies_[k].spin;
            }
        });
        sort_reported(report);
        const Deepest deepest = parallel_.sum(contacts_.size(), k_run, [&](std::size_t first, std::size_t last) {
            Deepest of_run;
            for (std::size_t k = first; k < last; ++k) of_run += {-contacts_[k].gap};
            return of_run;
        });
        report.deepest = std::max(report.deepest, deepest.overlap);
    }

    const Scene& scene_;
    Parallel parallel_;
    GapDetection detection_;
    GapSolver solver_;
    PositionCorrection correction_;
    Repair repair_;
    Rejection rejection_;
    Stillness stillness_;
    StepMemory memory_{parallel_};
    std::vector<SolverBody> bodies_;
    PoseSet before_, trial_;
    std::vector<GapContact> contacts_;
    std::vector<PairContacts> pairs_;
    bool detected_ = false;
    int careful_ = 0;
    std::int64_t times_set_out_ = 0;  ///< from rest, in this run
    bool creeping_ = false;           ///< at rest a few steps ago, set out slowly, and neither held nor fast since
    bool at_rest_ = false;            ///< no grain had any velocity when the step began
    double granted_ = 0.0;            ///< energy that this step's correction may add without paying [J/m]
    double repair_lift_ = 0.0;        ///< energy that this step's repair has added [J/m]
    double opening_unit_ = 0.0;       ///< lifts every grain by its resting gap [J/m]
    double opening_left_ = 0.0;       ///< what corrections may still add without paying [J/m]
    int overlapping_ = 0;
};

void ContactEngine::save(Checkpoint& checkpoint) const {
    checkpoint.put("contact/state",
                   std::vector<std::int64_t>{detected_ ? 1 : 0, careful_, detection_.began_clean() ? 1 : 0,
                                             times_set_out_, creeping_ ? 1 : 0});
    checkpoint.put("contact/opening", std::vector<double>{opening_left_});
    save_contacts(contacts_, pairs_, checkpoint);
}

void ContactEngine::load(const Checkpoint& checkpoint) {
    const auto& state = checkpoint.integers("contact/state");
    detected_ = state.at(0) != 0;
    careful_ = static_cast<int>(state.at(1));
    if (state.at(2) != 0) detection_.begin_clean();
    times_set_out_ = state.at(3);
    creeping_ = state.at(4) != 0;
    opening_left_ = checkpoint.reals("contact/opening").at(0);
    load_contacts(checkpoint, contacts_, pairs_);
    for (GapContact& c : contacts_) c.resting = detection_.resting_gap(c.i, c.j);
    stillness_.forget();
}

}  // namespace

std::unique_ptr<Engine> make_contact(const Scene& scene) { return std::make_unique<ContactEngine>(scene); }

}  // namespace polargrain
