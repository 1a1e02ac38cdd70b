#include "src/engines/contact/gap_impacts.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_motion.h"

namespace polargrain {

namespace {

bool later(const GapImpacts::Strike& p, const GapImpacts::Strike& q) {
    return p.speed < q.speed || (p.speed == q.speed && p.contact > q.contact);
}

Motion motion_of(const SolverBody& body) { return {body.velocity, body.spin}; }

}  // namespace

void GapImpacts::begin(const std::vector<GapContact>& contacts, const Halfway& halfway, std::int64_t step, double time,
                       double dt) {
    halfway_ = &halfway;
    step_ = step;
    time_ = time;
    impact_speed_ = k_impact * std::sqrt(scene_.gravity.squaredNorm()) * dt;
    index_by_grain(contacts);
}

void GapImpacts::index_by_grain(const std::vector<GapContact>& contacts) {
    first_of_grain_.assign(static_cast<std::size_t>(scene_.grains.size()) + 1, 0);
    for (const GapContact& c : contacts) {
        ++first_of_grain_[at(c.i) + 1];
        if (!is_wall(c.j)) ++first_of_grain_[at(c.j) + 1];
    }
    for (std::size_t g = 0; g + 1 < first_of_grain_.size(); ++g) first_of_grain_[g + 1] += first_of_grain_[g];
    fill_.assign(first_of_grain_.begin(), first_of_grain_.end() - 1);
    of_grain_.resize(static_cast<std::size_t>(first_of_grain_.back()));
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        of_grain_[at(fill_[at(contacts[k].i)]++)] = static_cast<std::int32_t>(k);
        if (!is_wall(contacts[k].j)) of_grain_[at(fill_[at(contacts[k].j)]++)] = static_cast<std::int32_t>(k);
    }
}

bool GapImpacts::strikes(const GapContact& c, const std::vector<SolverBody>& bodies, double h, double& speed) const {
    if (!c.active) return false;
    speed = -normal_speed(c, bodies);
    if (speed <= impact_speed_) return false;
    // Gravity pulls both grains of a pair alike; against a wall it closes the gap as well.
    const double pull = is_wall(c.j) ? std::max(0.0, -scene_.gravity.dot(c.normal)) * h : 0.0;
    return c.gap - c.resting < (speed + pull) * h;
}

void GapImpacts::run(std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies, PoseSet& trial, double h,
                     StepReport& report) {
    heap_.clear();
    double speed = 0.0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        if (strikes(contacts[k], bodies, h, speed)) heap_.push_back({speed, static_cast<std::int32_t>(k), 0});
    }
    if (heap_.empty()) return;
    std::make_heap(heap_.begin(), heap_.end(), later);
    stamp_.assign(contacts.size(), 0);
    uses_.assign(contacts.size(), 0);
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), later);
        const Strike next = heap_.back();
        heap_.pop_back();
        const auto k = static_cast<std::size_t>(next.contact);
        if (next.stamp != stamp_[k]) continue;
        const double flight = time_to_wall(contacts[k], next.speed, contacts, h);
        if (flight > 0.0) {
            strike_in_flight(contacts[k], next.speed, flight, contacts, bodies, trial, report);
        } else {
            strike(contacts[k], next.speed, contacts, bodies, report);
        }
        ++uses_[k];
        for (const BodyIndex body : {contacts[k].i, contacts[k].j}) {
            if (is_wall(body)) continue;
            for (auto n = first_of_grain_[at(body)]; n < first_of_grain_[at(body) + 1]; ++n) {
                const std::int32_t touched = of_grain_[at(n)];
                ++stamp_[at(touched)];
                if (uses_[at(touched)] >= k_most_impacts || !strikes(contacts[at(touched)], bodies, h, speed)) continue;
                heap_.push_back({speed, touched, stamp_[at(touched)]});
                std::push_heap(heap_.begin(), heap_.end(), later);
            }
        }
    }
}

/// Time until a grain reaches its resting gap from a wall at rest [s], no longer than the sub-step; 0 where others are
/// near enough to take part.
double GapImpacts::time_to_wall(const GapContact& c, double speed, const std::vector<GapContact>& contacts,
                                double h) const {
    const double open = c.gap - c.resting;
    if (!is_wall(c.j) || open <= 0.0 || c.wall_velocity != Vec2::Zero()) return 0.0;
    for (auto n = first_of_grain_[at(c.i)]; n < first_of_grain_[at(c.i) + 1]; ++n) {
        const GapContact& other = contacts[at(of_grain_[at(n)])];
        if (&other != &c && other.active && other.gap - other.resting < k_alone * speed * h) return 0.0;
    }
    const double root = speed * speed - 2.0 * scene_.gravity.dot(c.normal) * open;
    return root > 0.0 ? std::min(h, 2.0 * open / (speed + std::sqrt(root))) : 0.0;
}

/// An impact of a grain that nothing else touches on a wall, at the moment at which they meet.
///
/// The sub-step kicks and moves by h whatever happens in it. So that the path is the exact one - free flight, impact,
/// free flight - the velocity goes back by the part of the kick that has been spent, and the pose gets what the
/// velocity before moved it more than the one after. (Among grains alone in a dense gas this is not worth it: others
/// come in between within the sub-step.)
void GapImpacts::strike_in_flight(GapContact& c, double speed, double flight, std::vector<GapContact>& contacts,
                                  std::vector<SolverBody>& bodies, PoseSet& trial, StepReport& report) {
    const Vec2 kick = flight * scene_.gravity;
    SolverBody& body = bodies[at(c.i)];
    body.velocity += kick;
    const Motion before = motion_of(body);
    strike(c, speed, contacts, bodies, report);
    const Vec2 way = flight * (before.velocity - body.velocity);
    const double turn = flight * (before.spin - body.spin);
    trial.centre[at(c.i)] += way;
    trial.angle[at(c.i)] += turn;
    body.velocity -= kick;
    for (auto m = first_of_grain_[at(c.i)]; m < first_of_grain_[at(c.i) + 1]; ++m) {
        GapContact& touched = contacts[at(of_grain_[at(m)])];
        const bool is_i = touched.i == c.i;
        const double opened = touched.normal.dot(way) + (is_i ? touched.arm_ni : touched.arm_nj) * turn;
        touched.gap += is_i ? opened : -opened;
    }
}

/// Both bodies of an impact after it, free or on their feet.
struct GapImpacts::Blow {
    Footing i, j;
    ImpactResult result;

    bool is_consistent() const { return i.is_consistent() && j.is_consistent(); }
};

void GapImpacts::strike(GapContact& c, double speed, std::vector<GapContact>& contacts, std::vector<SolverBody>& bodies,
                        StepReport& report) {
    stances_i_.clear();
    stances_j_.clear();
    if (!is_wall(c.j)) {
        add_stances(c.i, speed, contacts, bodies, stances_i_);
        add_stances(c.j, speed, contacts, bodies, stances_j_);
    }
    stances_i_.push_back({});
    stances_j_.push_back({});
    for (const Stance& stance_i : stances_i_) {
        for (const Stance& stance_j : stances_j_) {
            const Blow b = blow(c, bodies, stance_i, stance_j);
            const bool free = stance_i.foot == nullptr && stance_j.foot == nullptr;
            if (!free && (!b.is_consistent() || presses_another(b.i, stances_i_) || presses_another(b.j, stances_j_) ||
                          b.result.friction_loss < 0.0)) {
                continue;
            }
            take(c, b, stance_i.foot, stance_j.foot, bodies, report);
            return;
        }
    }
}

void GapImpacts::add_stances(BodyIndex grain, double speed, std::vector<GapContact>& contacts,
                             const std::vector<SolverBody>& bodies, std::vector<Stance>& stances) const {
    if (scene_.gravity == Vec2::Zero()) return;  // nothing makes it stand anywhere
    for (auto n = first_of_grain_[at(grain)]; n < first_of_grain_[at(grain) + 1]; ++n) {
        GapContact& c = contacts[at(of_grain_[at(n)])];
        if (!is_wall(c.j) || !c.active || c.gap > k_foot_gap * c.resting) continue;
        if (std::hypot(normal_speed(c, bodies), tangent_speed(c, bodies)) > k_foot_speed * speed) continue;
        for (const Grip grip : {Grip::holds, Grip::slips_back, Grip::slips_ahead}) stances.push_back({&c, grip});
    }
}

GapImpacts::Blow GapImpacts::blow(const GapContact& c, const std::vector<SolverBody>& bodies, const Stance& stance_i,
                                  const Stance& stance_j) const {
    const auto footing = [&](BodyIndex body, const Stance& stance) {
        if (is_wall(body)) return Footing(c.wall_velocity);
        const Vec2& centre = halfway_->centre(body);
        if (stance.foot == nullptr) return Footing(bodies[at(body)], centre);
        return Footing(bodies[at(body)], centre, *stance.foot, stance.grip);
    };
    Blow b{footing(c.i, stance_i), footing(c.j, stance_j), {}};
    const ContactFrame frame = contact_frame(c.normal, c.point, b.i, b.j);
    const Vec2 u = b.i.velocity_at(c.point) - b.j.velocity_at(c.point);
    b.result = solve_impact(frame, {u.dot(frame.tangent()), u.dot(frame.normal)}, c.friction, c.restitution);
    const Vec2 p = b.result.normal * c.normal + b.result.tangential * c.tangent();
    b.i.take(p, c.point);
    b.j.take(-p, c.point);
    return b;
}

/// Would it drive another of the places it stands on into the wall?
bool GapImpacts::presses_another(const Footing& footing, const std::vector<Stance>& stances) {
    if (!footing.stands()) return false;
    return std::any_of(stances.begin(), stances.end(), [&](const Stance& s) {
        return s.foot != nullptr && s.foot != footing.foot() &&
               (footing.velocity_at(s.foot->point) - s.foot->wall_velocity).dot(s.foot->normal) < 0.0;
    });
}

/// Books the impulse on i and j, and what their feet get.
void GapImpacts::take(GapContact& c, const Blow& b, GapContact* foot_i, GapContact* foot_j,
                      std::vector<SolverBody>& bodies, StepReport& report) const {
    report.ledger.restitution_loss += b.result.restitution_loss;
    report.ledger.friction_loss += b.result.friction_loss + b.i.foot_loss() + b.j.foot_loss();
    const SlipMode mode = b.i.stands() || b.j.stands() ? SlipMode::on_feet : b.result.mode;
    push_one(c, b.result.normal, b.result.tangential, mode, bodies, report);
    for (const auto& [footing, foot] : {std::pair{&b.i, foot_i}, std::pair{&b.j, foot_j}}) {
        if (foot == nullptr) continue;
        const Vec2 p = footing->foot_impulse();
        push_one(*foot, p.dot(foot->normal), p.dot(foot->tangent()), SlipMode::foot, bodies, report);
    }
}

void GapImpacts::push_one(GapContact& c, double normal, double tangential, SlipMode mode,
                          std::vector<SolverBody>& bodies, StepReport& report) const {
    const bool wall = is_wall(c.j);
    const Motion wall_motion{c.wall_velocity, 0.0};
    ImpactRecord r;
    r.i_before = motion_of(bodies[at(c.i)]);
    r.j_before = wall ? wall_motion : motion_of(bodies[at(c.j)]);
    r.closing_before = normal_speed(c, bodies);
    r.sliding_before = tangent_speed(c, bodies);
    push(c, bodies, normal, tangential);
    const Vec2 impulse = normal * c.normal + tangential * c.tangent();
    c.total_impulse += impulse;
    take_reaction(c, impulse, report);
    ++report.impacts;
    if (!report.record_impacts) return;
    r.time = time_;
    r.step = step_;
    r.i = c.i;
    r.j = c.j;
    r.point = c.point;
    r.normal = c.normal;
    r.centre_i = halfway_->centre(c.i);
    r.centre_j = wall ? c.point : halfway_->centre(c.j);
    r.restitution = c.restitution;
    r.friction = c.friction;
    r.mode = mode;
    r.impulse_normal = normal;
    r.impulse_tangential = tangential;
    r.closing_after = normal_speed(c, bodies);
    r.sliding_after = tangent_speed(c, bodies);
    r.i_after = motion_of(bodies[at(c.i)]);
    r.j_after = wall ? wall_motion : motion_of(bodies[at(c.j)]);
    report.impact_records.push_back(r);
}

}  // namespace polargrain
