#include "src/engines/contact/gap_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "src/engines/contact/energy_guard.h"
#include "src/engines/contact/equilibrium.h"
#include "src/engines/contact/gap_motion.h"
#include "src/model/contact_law.h"

namespace polargrain {

namespace {

/// Grains or contacts that a thread takes at a time.
constexpr std::size_t k_run = 1024;

}  // namespace

void GapSolver::advance(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, const PoseSet& start,
                        PoseSet& trial, std::int64_t step, double time, double dt, const StepEffort& effort,
                        StepReport& report) {
    start_ = &start;
    creeps_ = false;
    creep_speed_ = k_creep * dt * std::sqrt(scene_.gravity.squaredNorm());
    halfway_.find(start, bodies, dt);
    // Between steps, impulses are those of a usual sub-step.
    const double usual = static_cast<double>(effort.sub_steps()) / k_usual.sub_steps();
    scale_impulses(contacts, 1.0 / usual);
    prepare(contacts, bodies);
    find_moving_walls(contacts, time, dt);
    grains_ = bodies.size();
    bodies_ = bodies;
    const std::array<std::function<void()>, 2> both{[&] { lanes_.lay_out(contacts, start.centre, bodies_); },
                                                    [&] { by_grain_.index(contacts, grains_); }};
    parallel_.each(both.size(), [&](std::size_t k) { both[k](); });
    impacts_.begin({&contacts, &lanes_, &bodies_, &trial, &halfway_, &by_grain_, &report, step, time, dt});
    impacts_.find_all_closing(closing_);
    const double h = dt / effort.sub_steps();
    for (int s = 0; s < effort.sub_steps(); ++s) {
        set_wall_velocities(contacts, time + (s + 0.5) * h, h);
        impacts_.run(closing_, h);
        lasting(contacts, h, effort, s == 0);
        keep_energy(contacts, h);
        move(contacts, trial, h, report);
    }
    finish(contacts, bodies, report);
    scale_impulses(contacts, usual);
}

void GapSolver::prepare_at_rest(std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                const PoseSet& poses) {
    start_ = &poses;
    halfway_.find(poses, bodies, 0.0);
    prepare(contacts, bodies);
    bodies_ = bodies;
    lanes_.lay_out(contacts, poses.centre, bodies_);
}

void GapSolver::prepare(std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies) const {
    parallel_.runs(contacts.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            GapContact& c = contacts[k];
            c.active = true;
            c.total_impulse = Vec2::Zero();
            c.friction = pair_law(scene_, c.j, c.i).friction;
            halfway_.carry(c);
            halfway_.set_arms(c, bodies);
        }
    });
}

/// Contacts with walls that move in the step: their speeds change from sub-step to sub-step, and they do work.
void GapSolver::find_moving_walls(std::vector<GapContact>& contacts, double time, double dt) {
    moving_.clear();
    for (std::size_t k = first_with_wall(contacts); k < contacts.size(); ++k) {
        if (moves_between(wall_of(contacts[k]), time, time + dt)) {
            moving_.push_back(k);
        } else {
            contacts[k].wall_velocity = Vec2::Zero();  // where a step has been taken back, it may have moved later on
        }
    }
}

/// For the sub-step of length h about the time `middle`.
void GapSolver::set_wall_velocities(std::vector<GapContact>& contacts, double middle, double h) {
    for (const std::size_t k : moving_) {
        GapContact& c = contacts[k];
        c.wall_velocity = wall_state_over(wall_of(c), middle, h).velocity_at(c.point);
        foresee_strike(k, c, middle, h);
        lanes_.wall_body_of(k, bodies_).velocity = c.wall_velocity;
        closing_.push_back(static_cast<std::int32_t>(k));  // it may have become faster since it was looked at
    }
}

/// A wall that starts or stops within the sub-step goes its way with its mean velocity. But one that comes on faster
/// from then on strikes with its velocity after that, and from as much farther away as it would else come too near.
void GapSolver::foresee_strike(std::size_t contact, GapContact& c, double middle, double h) {
    const Wall& wall = wall_of(c);
    if (!starts_or_ends(wall, middle, h)) return;
    const Vec2 after = wall_state(wall, middle + 0.5 * h).velocity_at(c.point);
    const double faster = (after - c.wall_velocity).dot(c.normal);
    if (faster <= 0.0) return;
    c.wall_velocity = after;
    lanes_.widen(contact, h * faster);
}

const Wall& GapSolver::wall_of(const GapContact& c) const {
    return scene_.walls[static_cast<std::size_t>(wall_index(c.j))];
}

// --- lasting contacts ---

/// The first guess of the impulses is what they were in the sub-step before; as nothing else has changed, their sum on
/// a grain is what they gave it then.
void GapSolver::lasting(std::vector<GapContact>& contacts, double h, const StepEffort& effort, bool first) {
    const Vec2 kick = h * scene_.gravity;
    velocity_before_.resize(grains_);
    spin_before_.resize(grains_);
    push_.resize(grains_);
    parallel_.runs(grains_, k_run, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            SolverBody& body = bodies_[k];
            velocity_before_[k] = body.velocity;
            spin_before_[k] = body.spin;
            body.velocity += kick;
            if (first) {
                push_by_all(contacts, static_cast<GrainIndex>(k));
            } else if (pushed_[k]) {
                body.velocity += push_[k].velocity;
                body.spin += push_[k].spin;
            }
        }
    });
    if (rests(h)) {
        stop();
    } else {
        solve(contacts, h, effort, first);
    }
    find_pushed();
}

void GapSolver::solve(std::vector<GapContact>& contacts, double h, const StepEffort& effort, bool first) {
    const double kick = h * std::sqrt(scene_.gravity.squaredNorm());
    const SweepEffort sweeps{effort.sweeps.sweeps, effort.sweeps.settled * kick, effort.sweeps.in_pairs};
    const bool settles = lanes_.sweep(bodies_, h, sweeps);
    if (!first || !effort.together || !moving_.empty()) return;
    const bool found = !settles && find_together(contacts, h);
    if (!found && !(effort.creeping && settles)) return;
    creeps_ = slower_than(creep_speed_);
    if (slower_than(k_held * kick)) {
        stop();
    } else if (found) {
        lanes_.sweep(bodies_, h, sweeps);
    }
}

/// Of a slow bed. Where there is no answer, what the sweeps have found stays.
bool GapSolver::find_together(std::vector<GapContact>& contacts, double h) {
    const Vec2 kick = h * scene_.gravity;
    std::vector<double> open(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) open[k] = lanes_.open(k);
    std::vector<double> reach(grains_);
    for (std::size_t k = 0; k < grains_; ++k) reach[k] = outer_radius(scene_.shape_of(static_cast<GrainIndex>(k)));
    std::vector<Vec2> free_velocity(grains_);
    for (std::size_t k = 0; k < grains_; ++k) free_velocity[k] = velocity_before_[k] + kick;
    const auto found = find_equilibrium(
        {contacts, open, std::span(bodies_).first(grains_), reach, free_velocity, spin_before_, kick, h});
    if (!found) return false;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        contacts[k].normal_impulse = (*found)[k].x();
        contacts[k].tangent_impulse = (*found)[k].y();
        lanes_.set_impulse(k, (*found)[k]);
    }
    for (std::size_t k = 0; k < grains_; ++k) {
        bodies_[k].velocity = free_velocity[k];
        bodies_[k].spin = spin_before_[k];
        push_by_all(contacts, static_cast<GrainIndex>(k));
    }
    return true;
}

void GapSolver::find_pushed() {
    pushed_.assign(bodies_.size(), 0);
    lanes_.mark_pushed(pushed_);
}

/// Gives a grain the impulses of its contacts.
void GapSolver::push_by_all(const std::vector<GapContact>& contacts, GrainIndex grain) {
    SolverBody& body = bodies_[at(grain)];
    for (const std::int32_t k : by_grain_.of(grain)) {
        const GapContact& c = contacts[at(k)];
        if (c.normal_impulse <= 0.0) continue;
        c.i == grain ? push_i(c, body, c.normal_impulse, c.tangent_impulse)
                     : push_j(c, body, c.normal_impulse, c.tangent_impulse);
    }
}

/// Does the first guess hold every grain in its place? Then it is the solution, and the bed stays still to the last bit
/// (see Stillness) instead of following round-off for ever.
bool GapSolver::rests(double h) const {
    return moving_.empty() && slower_than(k_still * h * std::sqrt(scene_.gravity.squaredNorm()));
}

bool GapSolver::slower_than(double speed) const {
    for (std::size_t k = 0; k < grains_; ++k) {
        const double surface = bodies_[k].spin * outer_radius(scene_.shape_of(static_cast<GrainIndex>(k)));
        if (bodies_[k].velocity.squaredNorm() + surface * surface >= speed * speed) return false;
    }
    return true;
}

void GapSolver::stop() {
    for (std::size_t k = 0; k < grains_; ++k) {
        bodies_[k].velocity = Vec2::Zero();
        bodies_[k].spin = 0.0;
    }
}

/// Keeps the sub-step from creating energy because the sweeps have not converged.
///
/// Grains in lasting contact are slowed. Slower by the factor f, they have f^2 of their kinetic energy and take f of
/// their way against gravity, so some f always keeps the energy from rising; and as no target asks for parting, gaps
/// among slowed grains and to walls at rest are kept. While a moving wall pushes, grains slowed would be overrun; and a
/// bed that follows a floor slowly would be held back by a good part of its weight. Then it is swept on instead: each
/// change of an impulse takes energy in the frame of what it pushes against.
void GapSolver::keep_energy(const std::vector<GapContact>& contacts, double h) {
    const Balance balance = weigh(h);
    if (!moving_wall_pushes(contacts)) {
        if (balance.excess() > 0.0) slow_down(balance);
        return;
    }
    const double tolerance = k_unsettled * balance.kick + k_round_off * balance.before;
    double excess = balance.excess() - work_of_walls(contacts);
    for (int more = 0; more < k_most_more_sweeps && excess > tolerance; more += k_more_sweeps) {
        lanes_.sweep(bodies_, h, {k_more_sweeps, 0.0, false});
        find_pushed();
        excess = weigh(h).excess() - work_of_walls(contacts);
    }
}

/// Notes what lasting contacts have given each grain, too.
GapSolver::Balance GapSolver::weigh(double h) {
    const Vec2 kick = h * scene_.gravity;
    return parallel_.sum(grains_, k_run, [&](std::size_t first, std::size_t last) {
        Balance sum;
        for (std::size_t k = first; k < last; ++k) {
            if (!pushed_[k]) continue;
            const SolverBody& body = bodies_[k];
            push_[k] = {body.velocity - (velocity_before_[k] + kick), body.spin - spin_before_[k]};
            const SolverBody earlier{velocity_before_[k], spin_before_[k], body.inverse_mass, body.inverse_inertia};
            sum += {kinetic_energy(earlier), kinetic_energy(body),
                    h * scene_.gravity.dot(body.velocity) / body.inverse_mass,
                    0.5 * kick.squaredNorm() / body.inverse_mass};
        }
        return sum;
    });
}

void GapSolver::slow_down(const Balance& balance) {
    // The larger root of after f^2 - fall f - before = 0, in the form that loses no digits.
    const auto& [before, after, fall, kick] = balance;
    const double root = std::sqrt(fall * fall + 4.0 * after * before);
    const double f = fall >= 0.0 ? (fall + root) / (2.0 * after) : 2.0 * before / (root - fall);
    for (std::size_t k = 0; k < grains_; ++k) {
        if (!pushed_[k]) continue;
        bodies_[k].velocity *= f;
        bodies_[k].spin *= f;
    }
}

bool GapSolver::moving_wall_pushes(const std::vector<GapContact>& contacts) const {
    return std::any_of(moving_.begin(), moving_.end(), [&](std::size_t k) {
        return lanes_.normal_impulse(k) > 0.0 && contacts[k].wall_velocity != Vec2::Zero();
    });
}

/// Of walls on grains in this sub-step [J/m].
double GapSolver::work_of_walls(const std::vector<GapContact>& contacts) const {
    double work = 0.0;
    for (const std::size_t k : moving_) {
        const GapContact& c = contacts[k];
        const Vec2 impulse = lanes_.normal_impulse(k) * c.normal + lanes_.tangent_impulse(k) * c.tangent();
        work += impulse.dot(c.wall_velocity);
    }
    return work;
}

void GapSolver::move(std::vector<GapContact>& contacts, PoseSet& trial, double h, StepReport& report) {
    const LaneLosses losses = lanes_.move(bodies_, {h, impacts_.slow(), h * std::sqrt(scene_.gravity.squaredNorm())});
    report.ledger.restitution_loss += losses.normal;
    report.ledger.friction_loss += losses.tangent;
    lanes_.find_closing(closing_);
    for (const std::size_t k : moving_) book(k, contacts[k], report);
    lanes_.each_left([&](std::size_t k) { leave_edge(k, contacts[k], report); });
    const Vec2 half_kick = 0.5 * h * scene_.gravity;
    report.ledger.restitution_loss += parallel_.sum(grains_, k_run, [&](std::size_t first, std::size_t last) {
        double loss = 0.0;
        for (std::size_t k = first; k < last; ++k) {
            SolverBody& body = bodies_[k];
            if (pushed_[k]) {
                body.touched = true;
                const Vec2 change = body.velocity - velocity_before_[k];
                const double turn = body.spin - spin_before_[k];
                loss += 0.5 * (change.squaredNorm() / body.inverse_mass + turn * turn / body.inverse_inertia);
                trial.centre[k] += h * body.velocity;
            } else {
                trial.centre[k] += h * (body.velocity - half_kick);
            }
            trial.angle[k] += h * body.spin;
        }
        return loss;
    });
}

/// Hands the impulses of the sub-steps since the last time to the contact, and to its wall.
void GapSolver::book(std::size_t contact, GapContact& c, StepReport& report) {
    const Vec2 impulse = lanes_.take(contact, c);
    c.total_impulse += impulse;
    take_reaction(c, impulse, report);
}

void GapSolver::finish(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, StepReport& report) {
    const std::size_t walls = first_with_wall(contacts);
    parallel_.runs(walls, k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) contacts[k].total_impulse += lanes_.take(k, contacts[k]);
    });
    for (std::size_t k = walls; k < contacts.size(); ++k) book(k, contacts[k], report);
    std::copy_n(bodies_.begin(), grains_, bodies.begin());
}

/// Edge-end rule: the point has passed the end of its edge. The other body's corner now runs along the edge that
/// trails behind the point, with the same gap; where the turn is too sharp the contact is over for this step.
void GapSolver::leave_edge(std::size_t contact, GapContact& c, StepReport& report) {
    constexpr double k_sharp = 0.2;  // cosine of the turn
    const bool towards_t = lanes_.beyond_high(contact);
    book(contact, c, report);
    const double pressing = c.normal_impulse;
    add_to_guess(c, -1.0);
    c.normal_impulse = 0.0;
    c.tangent_impulse = 0.0;
    c.active = false;
    const std::optional<Vec2> normal = normal_that_follows(c, towards_t);
    const double cosine = normal ? normal->dot(c.normal) : 0.0;
    if (cosine >= k_sharp) {
        c.normal = *normal;
        c.normal_impulse = pressing * cosine;
        c.low = -std::numeric_limits<double>::infinity();
        c.high = std::numeric_limits<double>::infinity();
        c.active = true;
        halfway_.set_arms(c, bodies_);
        add_to_guess(c, 1.0);
        closing_.push_back(static_cast<std::int32_t>(contact));  // along another normal
    }
    lanes_.put(c, contact, bodies_);
}

/// What the contact's impulses give its grains, times `part`, into the first guess of the next sub-step.
void GapSolver::add_to_guess(const GapContact& c, double part) {
    const Vec2 p = part * (c.normal_impulse * c.normal + c.tangent_impulse * c.tangent());
    const SolverBody& i = bodies_[at(c.i)];
    push_[at(c.i)].velocity += i.inverse_mass * p;
    push_[at(c.i)].spin += part * i.inverse_inertia * (c.normal_impulse * c.arm_ni + c.tangent_impulse * c.arm_ti);
    if (is_wall(c.j)) return;
    const SolverBody& j = bodies_[at(c.j)];
    push_[at(c.j)].velocity -= j.inverse_mass * p;
    push_[at(c.j)].spin -= part * j.inverse_inertia * (c.normal_impulse * c.arm_nj + c.tangent_impulse * c.arm_tj);
}

std::optional<Vec2> GapSolver::normal_that_follows(const GapContact& c, bool towards_t) const {
    if (c.vertex < 0 || (!c.on_i && is_wall(c.j))) return std::nullopt;
    const BodyIndex owner = c.on_i ? c.i : c.j;
    const auto* polygon = std::get_if<PolarPolygon>(&scene_.shape_of(owner));
    if (polygon == nullptr) return std::nullopt;
    const auto turned = [&](const Vec2& v) { return halfway_.turned(owner, start_->pose[at(owner)].turned(v)); };
    const Vec2 t = c.tangent();
    const Vec2 v = polygon->vertex(c.vertex);
    // The owner's point moves along +t if it is i's and the pair travels along t, and so on.
    const bool point_along_t = c.on_i == towards_t;
    const Vec2 to_next = turned(polygon->vertex(polygon->next(c.vertex)) - v);
    const Vec2 to_previous = turned(polygon->vertex(polygon->previous(c.vertex)) - v);
    const bool next_trails = point_along_t ? to_next.dot(t) < to_previous.dot(t) : to_next.dot(t) > to_previous.dot(t);
    const int edge = next_trails ? c.vertex : polygon->previous(c.vertex);
    const Vec2 outward = turned(polygon->normal(edge));
    return c.on_i ? Vec2(-outward) : outward;
}

}  // namespace polargrain
