#include "src/engines/contact/gap_impacts.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_motion.h"
#include "src/model/contact_law.h"

namespace polargrain {

namespace {

bool later(const GapImpacts::Strike& p, const GapImpacts::Strike& q) {
    return p.speed < q.speed || (p.speed == q.speed && p.contact > q.contact);
}

Motion motion_of(const SolverBody& body) { return {body.velocity, body.spin}; }

}  // namespace

void GapImpacts::begin(const StepInHand& step) {
    now_ = step;
    impact_speed_ = k_impact * std::sqrt(scene_.gravity.squaredNorm()) * step.dt;
    by_grain_.index(*step.contacts, static_cast<std::size_t>(scene_.grains.size()));
}

void GapImpacts::find_all_closing(std::vector<std::int32_t>& closing) const {
    closing.clear();
    for (std::size_t k = 0; k < now_.contacts->size(); ++k) {
        if (-normal_speed((*now_.contacts)[k], *now_.bodies) > impact_speed_) {
            closing.push_back(static_cast<std::int32_t>(k));
        }
    }
}

/// Gap less resting gap [m].
double GapImpacts::open(const GapContact& c) const {
    return now_.lanes->open(static_cast<std::size_t>(&c - now_.contacts->data()));
}

bool GapImpacts::strikes(const GapContact& c, double h, double& speed) const {
    if (!c.active) return false;
    speed = -normal_speed(c, *now_.bodies);
    if (speed <= impact_speed_) return false;
    // Gravity pulls both grains of a pair alike; against a wall it closes the gap as well.
    const double pull = is_wall(c.j) ? std::max(0.0, -scene_.gravity.dot(c.normal)) * h : 0.0;
    return open(c) < (speed + pull) * h;
}

void GapImpacts::run(const std::vector<std::int32_t>& closing, double h) {
    std::vector<GapContact>& contacts = *now_.contacts;
    heap_.clear();
    double speed = 0.0;
    for (const std::int32_t k : closing) {
        if (strikes(contacts[at(k)], h, speed)) heap_.push_back({speed, k, 0});
    }
    if (heap_.empty()) return;
    std::make_heap(heap_.begin(), heap_.end(), later);
    stamp_.assign(contacts.size(), 0);
    uses_.assign(contacts.size(), 0);
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), later);
        const Strike next = heap_.back();
        heap_.pop_back();
        if (next.stamp != stamp_[at(next.contact)]) continue;
        GapContact& c = contacts[at(next.contact)];
        const double flight = time_to_wall(c, next.speed, h);
        if (flight > 0.0) {
            strike_in_flight(c, next.speed, flight);
        } else {
            strike(c, next.speed);
        }
        ++uses_[at(next.contact)];
        for (const BodyIndex body : {c.i, c.j}) {
            if (is_wall(body)) continue;
            for (const std::int32_t touched : by_grain_.of(body)) {
                ++stamp_[at(touched)];
                if (uses_[at(touched)] >= k_most_impacts || !strikes(contacts[at(touched)], h, speed)) continue;
                heap_.push_back({speed, touched, stamp_[at(touched)]});
                std::push_heap(heap_.begin(), heap_.end(), later);
            }
        }
    }
}

/// Time until a grain reaches its resting gap from a wall at rest [s], no longer than the sub-step; 0 where others are
/// near enough to take part.
double GapImpacts::time_to_wall(const GapContact& c, double speed, double h) const {
    if (!is_wall(c.j) || c.wall_velocity != Vec2::Zero()) return 0.0;
    const double way = open(c);
    if (way <= 0.0) return 0.0;
    for (const std::int32_t k : by_grain_.of(c.i)) {
        const GapContact& other = (*now_.contacts)[at(k)];
        if (&other != &c && other.active && open(other) < k_alone * speed * h) return 0.0;
    }
    const double root = speed * speed - 2.0 * scene_.gravity.dot(c.normal) * way;
    return root > 0.0 ? std::min(h, 2.0 * way / (speed + std::sqrt(root))) : 0.0;
}

/// An impact of a grain that nothing else touches on a wall, at the moment at which they meet.
///
/// The sub-step kicks and moves by h whatever happens in it. So that the path is the exact one - free flight, impact,
/// free flight - the velocity goes back by the part of the kick that has been spent, and the pose gets what the
/// velocity before moved it more than the one after. (Among grains alone in a dense gas this is not worth it: others
/// come in between within the sub-step.)
void GapImpacts::strike_in_flight(GapContact& c, double speed, double flight) {
    const Vec2 kick = flight * scene_.gravity;
    SolverBody& body = (*now_.bodies)[at(c.i)];
    body.velocity += kick;
    const Motion before = motion_of(body);
    strike(c, speed);
    const Vec2 way = flight * (before.velocity - body.velocity);
    const double turn = flight * (before.spin - body.spin);
    now_.trial->centre[at(c.i)] += way;
    now_.trial->angle[at(c.i)] += turn;
    body.velocity -= kick;
    for (const std::int32_t k : by_grain_.of(c.i)) {
        const GapContact& touched = (*now_.contacts)[at(k)];
        const bool is_i = touched.i == c.i;
        const double opened = touched.normal.dot(way) + (is_i ? touched.arm_ni : touched.arm_nj) * turn;
        now_.lanes->widen(at(k), is_i ? opened : -opened);
    }
}

/// Both bodies of an impact after it, free or on their feet.
struct GapImpacts::Blow {
    Footing i, j;
    double restitution;
    ImpactResult result;

    bool is_consistent() const { return i.is_consistent() && j.is_consistent(); }
};

void GapImpacts::strike(GapContact& c, double speed) {
    stances_i_.clear();
    stances_j_.clear();
    if (!is_wall(c.j)) {
        add_stances(c.i, speed, stances_i_);
        add_stances(c.j, speed, stances_j_);
    }
    stances_i_.push_back({});
    stances_j_.push_back({});
    const double restitution = drawn_restitution(scene_, now_.step, c.j, c.i);
    for (const Stance& stance_i : stances_i_) {
        for (const Stance& stance_j : stances_j_) {
            const Blow b = blow(c, restitution, stance_i, stance_j);
            const bool free = stance_i.foot == nullptr && stance_j.foot == nullptr;
            if (!free && (!b.is_consistent() || presses_another(b.i, stances_i_) || presses_another(b.j, stances_j_) ||
                          b.result.friction_loss < 0.0)) {
                continue;
            }
            take(c, b, stance_i.foot, stance_j.foot);
            return;
        }
    }
}

void GapImpacts::add_stances(GrainIndex grain, double speed, std::vector<Stance>& stances) const {
    if (scene_.gravity == Vec2::Zero()) return;  // nothing makes it stand anywhere
    for (const std::int32_t k : by_grain_.of(grain)) {
        GapContact& c = (*now_.contacts)[at(k)];
        if (!is_wall(c.j) || !c.active || open(c) > (k_foot_gap - 1.0) * c.resting) continue;
        const double normal = normal_speed(c, *now_.bodies);
        const double tangential = tangent_speed(c, *now_.bodies);
        if (std::sqrt(normal * normal + tangential * tangential) > k_foot_speed * speed) continue;
        for (const Grip grip : {Grip::holds, Grip::slips_back, Grip::slips_ahead}) stances.push_back({&c, grip});
    }
}

GapImpacts::Blow GapImpacts::blow(const GapContact& c, double restitution, const Stance& stance_i,
                                  const Stance& stance_j) const {
    const std::vector<SolverBody>& bodies = *now_.bodies;
    const auto footing = [&](BodyIndex body, const Stance& stance) {
        if (is_wall(body)) return Footing(c.wall_velocity);
        const Vec2& centre = now_.halfway->centre(body);
        if (stance.foot == nullptr) return Footing(bodies[at(body)], centre);
        return Footing(bodies[at(body)], centre, *stance.foot, stance.grip);
    };
    Blow b{footing(c.i, stance_i), footing(c.j, stance_j), restitution, {}};
    const ContactFrame frame = contact_frame(c.normal, c.point, b.i, b.j);
    const Vec2 u = b.i.velocity_at(c.point) - b.j.velocity_at(c.point);
    b.result = solve_impact(frame, {u.dot(frame.tangent()), u.dot(frame.normal)}, c.friction, restitution);
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
void GapImpacts::take(GapContact& c, const Blow& b, GapContact* foot_i, GapContact* foot_j) const {
    EnergyLedger& ledger = now_.report->ledger;
    ledger.restitution_loss += b.result.restitution_loss;
    ledger.friction_loss += b.result.friction_loss + b.i.foot_loss() + b.j.foot_loss();
    const SlipMode mode = b.i.stands() || b.j.stands() ? SlipMode::on_feet : b.result.mode;
    push_one(c, b.result.normal, b.result.tangential, mode, b.restitution);
    for (const auto& [footing, foot] : {std::pair{&b.i, foot_i}, std::pair{&b.j, foot_j}}) {
        if (foot == nullptr) continue;
        const Vec2 p = footing->foot_impulse();
        push_one(*foot, p.dot(foot->normal), p.dot(foot->tangent()), SlipMode::foot,
                 drawn_restitution(scene_, now_.step, foot->j, foot->i));
    }
}

void GapImpacts::push_one(GapContact& c, double normal, double tangential, SlipMode mode, double restitution) const {
    std::vector<SolverBody>& bodies = *now_.bodies;
    StepReport& report = *now_.report;
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
    r.time = now_.time;
    r.step = now_.step;
    r.i = c.i;
    r.j = c.j;
    r.point = c.point;
    r.normal = c.normal;
    r.centre_i = now_.halfway->centre(c.i);
    r.centre_j = wall ? c.point : now_.halfway->centre(c.j);
    r.restitution = restitution;
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
