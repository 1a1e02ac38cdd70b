#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "src/engines/contact/by_grain.h"
#include "src/engines/contact/contact_lanes.h"
#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_impacts.h"
#include "src/engines/contact/halfway.h"
#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// How hard the lasting contacts of a step are solved.
struct StepEffort {
    SweepEffort sweeps;
    /// Where the sweeps of the first sub-step do not settle, all impulses are found together. For slow beds.
    bool together = false;
    bool creeping = false;  ///< the bed is followed while it creeps: one sub-step will do

    int sub_steps() const { return creeping ? 1 : 8; }
};

/// Carries velocities and poses through one step in sub-steps, with impacts and lasting contacts.
///
/// A sub-step of length h:
/// 1. impacts (GapImpacts), before gravity's kick, because then kinetic energy cannot rise);
/// 2. gravity's kick, v += g h;
/// 3. lasting contacts: projected Gauss-Seidel, first guess from the sub-step before. Normal: the gap may close to the
///    resting gap but not beyond, u_n >= -(gap - resting) / h, else no approach (never a push-out velocity); friction
///    within the cone of the normal impulse just found. Of a bed at rest that they do not settle, all impulses are
///    found together from time to time (find_equilibrium);
/// 4. gaps and poses move on linearly; points that leave their edge hand over to the edge that follows.
/// Energy: kick, solve and move together change it by the sum of p.u(after) - |g h + dv|^2 / 2 in the mass metric;
/// a converged solve has p.u <= 0. A grain that no lasting contact has pushed in a sub-step moves by the exact
/// ballistic way instead.
class GapSolver {
public:
    // Here `settled` is in units of g h.
    static constexpr StepEffort k_usual{{4, 1e-3, true}};
    static constexpr StepEffort k_careful{{8, 1e-3, true}};     ///< where many grains overlap
    static constexpr StepEffort k_at_rest{{32, 1e-10, false}};  ///< where nothing moves: the forces are left to find
    /// Where a bed at rest sets out slowly, once its forces are known: sweeps would stop it again.
    static constexpr StepEffort k_creeping{{32, 1e-10, false}, true, true};
    static constexpr double k_creep = 10.0;  ///< of gravity's kick in a step: what moves faster does not creep

    static constexpr double k_still = 1e-9;  ///< of g h: a bed that gets no faster in a sub-step is at rest

    // Where a moving wall pushes and energy rises by more than these parts of what gravity's kick is worth and of the
    // kinetic energy, the sub-step is swept on, some sweeps at a time.
    static constexpr double k_unsettled = 1e-3;
    static constexpr double k_round_off = 1e-12;
    static constexpr int k_more_sweeps = 4;
    static constexpr int k_most_more_sweeps = 32;

    explicit GapSolver(const Scene& scene)
        : scene_(scene), parallel_(std::max(1, scene.threads)), halfway_(scene), impacts_(scene), lanes_(scene) {}

    /// Advances bodies and trial poses from time to time + dt. `start` are the poses at which the contacts were found;
    /// the trial poses equal them at first. Fills impulses and losses of the report.
    void advance(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, const PoseSet& start,
                 PoseSet& trial, std::int64_t step, double time, double dt, const StepEffort& effort,
                 StepReport& report);

    /// In the last step all impulses were found together, and the bed moves slowly with them.
    bool creeps() const { return creeps_; }

    /// The groups in which the contacts are swept.
    const ContactLanes& lanes() const { return lanes_; }

    /// Lays the contacts out for poses that stand still.
    void prepare_at_rest(std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                         const PoseSet& poses);

private:
    /// Kinetic energy of the pushed grains before and after a sub-step, what gravity does on their way in it, and the
    /// kinetic energy that its kick would give them at rest [J/m].
    struct Balance {
        double before = 0.0, after = 0.0, fall = 0.0, kick = 0.0;

        double excess() const { return after - fall - before; }
        Balance& operator+=(const Balance& more) {
            before += more.before;
            after += more.after;
            fall += more.fall;
            kick += more.kick;
            return *this;
        }
    };

    void prepare(std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies) const;
    void find_moving_walls(std::vector<GapContact>& contacts, double time, double dt);
    void set_wall_velocities(std::vector<GapContact>& contacts, double middle, double h);
    void foresee_strike(std::size_t contact, GapContact& c, double middle, double h);
    const Wall& wall_of(const GapContact& c) const;

    void lasting(std::vector<GapContact>& contacts, double h, const StepEffort& effort, bool first);
    void solve(std::vector<GapContact>& contacts, double h, const StepEffort& effort, bool first);
    bool find_together(std::vector<GapContact>& contacts, double h);
    void push_by_all(const std::vector<GapContact>& contacts, GrainIndex grain);
    bool rests(double h) const;
    bool slower_than(double speed) const;
    void stop();
    void find_pushed();
    void keep_energy(const std::vector<GapContact>& contacts, double h);
    Balance weigh(double h);
    void slow_down(const Balance& balance);
    bool moving_wall_pushes(const std::vector<GapContact>& contacts) const;
    double work_of_walls(const std::vector<GapContact>& contacts) const;
    void move(std::vector<GapContact>& contacts, PoseSet& trial, double h, StepReport& report);
    void leave_edge(std::size_t contact, GapContact& c, StepReport& report);
    void add_to_guess(const GapContact& c, double part);
    std::optional<Vec2> normal_that_follows(const GapContact& c, bool towards_t) const;
    void book(std::size_t contact, GapContact& c, StepReport& report);
    void finish(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, StepReport& report);

    /// What lasting contacts have given a grain in the last sub-step.
    struct Push {
        Vec2 velocity = Vec2::Zero();
        double spin = 0.0;
    };

    const Scene& scene_;
    Parallel parallel_;
    const PoseSet* start_ = nullptr;  ///< poses at which the contacts were found
    Halfway halfway_;
    GapImpacts impacts_;
    ContactLanes lanes_;
    ByGrain by_grain_;                ///< contacts
    std::vector<SolverBody> bodies_;  ///< grains, then what stands for walls
    std::size_t grains_ = 0;
    std::vector<std::size_t> moving_;  ///< contacts with walls that move
    std::vector<std::int32_t> closing_;
    std::vector<Vec2> velocity_before_;
    std::vector<double> spin_before_;
    std::vector<Push> push_;
    std::vector<char> pushed_;
    double creep_speed_ = 0.0;  ///< [m/s]
    bool creeps_ = false;
};

}  // namespace polargrain
