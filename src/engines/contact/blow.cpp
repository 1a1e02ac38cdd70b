#include "src/engines/contact/blow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/engines/contact/face_blow.h"
#include "src/engines/contact/gap_motion.h"
#include "src/model/contact_law.h"

namespace polargrain {

void BlowSolver::begin(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                       const Halfway& halfway, const ContactLanes& lanes, const ByGrain& by_grain, std::int64_t step) {
    contacts_ = &contacts;
    bodies_ = &bodies;
    halfway_ = &halfway;
    lanes_ = &lanes;
    by_grain_ = &by_grain;
    step_ = step;
}

bool BlowSolver::meets(std::int32_t k, double speed, double h) const {
    const GapContact& c = contact(k);
    // Gravity pulls both grains of a pair alike; against a wall it closes the gap as well.
    const double pull = is_wall(c.j) ? std::max(0.0, -scene_.gravity.dot(c.normal)) * h : 0.0;
    return lanes_->open(static_cast<std::size_t>(k)) < (speed + pull) * h;
}

/// Both bodies of an impact after it, free or on their feet.
struct BlowSolver::Answer {
    Footing i, j;
    FaceBlow blow;

    bool is_consistent() const { return i.is_consistent() && j.is_consistent() && blow.result.friction_loss >= 0.0; }
};

Blow BlowSolver::solve(std::int32_t struck, double speed, double h) const {
    const GapContact& c = contact(struck);
    const double restitution = drawn_restitution(scene_, step_, c.j, c.i);
    thread_local std::vector<Stance> stances_i, stances_j;
    stances_i.clear();
    stances_j.clear();
    if (!is_wall(c.j)) {
        find_stances(c.i, speed, stances_i);
        find_stances(c.j, speed, stances_j);
    }
    const Ends ends = face_of(struck, speed, h);
    stances_i.push_back({});
    stances_j.push_back({});
    for (const Stance& stance_i : stances_i) {
        for (const Stance& stance_j : stances_j) {
            const Answer a = answer(ends, restitution, stance_i, stance_j);
            const bool free = stance_i.free() && stance_j.free();
            if (free || (a.is_consistent() && !presses_another(a.i, stances_i) && !presses_another(a.j, stances_j))) {
                return blow(ends, a, restitution, stance_i, stance_j);
            }
        }
    }
    return {};
}

/// Does another contact of the pair meet in this sub-step too, along the same normal and as fast?
bool BlowSolver::lands_with(const GapContact& struck, std::int32_t other, double speed, double h) const {
    constexpr double k_parallel = 0.9999;
    const GapContact& c = contact(other);
    if (c.i != struck.i || c.j != struck.j || !c.active || c.normal.dot(struck.normal) < k_parallel) return false;
    const double closing = -normal_speed(c, *bodies_);
    return std::abs(closing - speed) <= k_flat * speed && meets(other, closing, h);
}

/// The ends of the face that lands flat with the contact: those of the contacts that meet with it which are farthest
/// apart. Twice the contact itself where it is alone.
BlowSolver::Ends BlowSolver::face_of(std::int32_t struck, double speed, double h) const {
    const GapContact& c = contact(struck);
    Ends ends{struck, struck};
    const auto station = [&](std::int32_t k) { return c.tangent().dot(contact(k).point); };
    for (const std::int32_t k : by_grain_->of(c.i)) {
        if (k == struck || !lands_with(c, k, speed, h)) continue;
        if (station(k) < station(ends.first)) ends.first = k;
        if (station(k) > station(ends.second)) ends.second = k;
    }
    return ends;
}

void BlowSolver::find_stances(GrainIndex grain, double speed, std::vector<Stance>& stances) const {
    if (scene_.gravity == Vec2::Zero()) return;  // nothing makes it stand anywhere
    for (const std::int32_t k : by_grain_->of(grain)) {
        const GapContact& c = contact(k);
        if (!is_wall(c.j) || !c.active) continue;
        if (lanes_->open(static_cast<std::size_t>(k)) > (k_foot_gap - 1.0) * c.resting) continue;
        const double normal = normal_speed(c, *bodies_);
        const double tangential = tangent_speed(c, *bodies_);
        if (std::sqrt(normal * normal + tangential * tangential) > k_foot_speed * speed) continue;
        for (const Grip grip : {Grip::holds, Grip::slips_back, Grip::slips_ahead}) stances.push_back({k, grip});
    }
}

BlowSolver::Answer BlowSolver::answer(const Ends& ends, double restitution, const Stance& stance_i,
                                      const Stance& stance_j) const {
    const GapContact& first = contact(ends.first);
    const GapContact& second = contact(ends.second);
    const auto footing = [&](BodyIndex body, const Stance& stance) {
        if (is_wall(body)) return Footing(first.wall_velocity);
        const Vec2 centre = first.point - halfway_->arm(first, body);
        if (stance.free()) return Footing((*bodies_)[at(body)], centre);
        return Footing((*bodies_)[at(body)], centre, contact(stance.foot), stance.grip);
    };
    Answer a{footing(first.i, stance_i), footing(first.j, stance_j), {}};
    a.blow = solve_face_blow(first, second, a.i, a.j, restitution);
    SharedImpact(first, second, a.i, a.j, a.blow.of_second).push(a.blow.result, a.i, a.j);
    return a;
}

/// Would it drive another of the places it stands on into the wall?
bool BlowSolver::presses_another(const Footing& footing, const std::vector<Stance>& stances) const {
    if (!footing.stands()) return false;
    return std::any_of(stances.begin(), stances.end(), [&](const Stance& s) {
        if (s.free() || &contact(s.foot) == footing.foot()) return false;
        const GapContact& other = contact(s.foot);
        return (footing.velocity_at(other.point) - other.wall_velocity).dot(other.normal) < 0.0;
    });
}

Blow BlowSolver::blow(const Ends& ends, const Answer& a, double restitution, const Stance& stance_i,
                      const Stance& stance_j) const {
    const auto& [result, of_second] = a.blow;
    Blow b;
    b.restitution_loss = result.restitution_loss + a.i.restitution_loss() + a.j.restitution_loss();
    b.friction_loss = result.friction_loss + a.i.friction_loss() + a.j.friction_loss();
    const SlipMode alone = a.i.stands() || a.j.stands() ? SlipMode::on_feet : result.mode;
    for (const auto& [end, share] : {std::pair{ends.first, 1.0 - of_second}, std::pair{ends.second, of_second}}) {
        if (share == 0.0) continue;
        const SlipMode mode = share == 1.0 ? alone : SlipMode::on_face;
        b.add({end, share * result.normal, share * result.tangential, restitution, mode});
    }
    for (const auto& [footing, stance] : {std::pair{&a.i, &stance_i}, std::pair{&a.j, &stance_j}}) {
        if (stance->free()) continue;
        const GapContact& foot = contact(stance->foot);
        const Vec2 p = footing->foot_impulse();
        b.add({stance->foot, p.dot(foot.normal), p.dot(foot.tangent()),
               drawn_restitution(scene_, step_, foot.j, foot.i), SlipMode::foot});
    }
    return b;
}

}  // namespace polargrain
