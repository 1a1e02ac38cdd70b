#include "src/engines/contact/gap_impacts.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_motion.h"
#include "src/engines/contact/pose_set.h"
#include "src/model/contact_law.h"

namespace polargrain {

namespace {

/// Contacts, impacts, and contacts to be looked at, that a thread takes at a time.
constexpr std::size_t k_run = 1024;
constexpr std::size_t k_impacts_a_run = 16;  // at least
constexpr std::size_t k_runs_a_thread = 2;
constexpr std::size_t k_looks_a_run = 256;

Motion motion_of(const SolverBody& body) { return {body.velocity, body.spin}; }

}  // namespace

GapImpacts::GapImpacts(const Scene& scene)
    : scene_(scene), parallel_(std::max(1, scene.threads)), blow_solver_(scene), meetings_(scene) {}

void GapImpacts::begin(const StepInHand& step) {
    now_ = step;
    impact_speed_ = k_impact * std::sqrt(scene_.gravity.squaredNorm()) * step.dt;
    const auto grains = static_cast<std::size_t>(scene_.grains.size());
    blow_solver_.begin(*step.contacts, *step.bodies, *step.halfway, *step.lanes, *step.by_grain, step.step);
    meetings_.begin({step.contacts, step.lanes, step.bodies, step.trial, step.by_grain, impact_speed_});
    round_ = 0;
    first_round_ = 1;
    left_ = step.dt;
    grains_.assign(grains, {});
    added_.assign(step.contacts->size(), 0);
}

void GapImpacts::find_all_closing(std::vector<std::int32_t>& closing) {
    std::vector<char> closes(now_.contacts->size());
    parallel_.runs(closes.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) meetings_.foresee(k, 0.0, left_);
    });
    parallel_.runs(closes.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) closes[k] = meetings_.closes_fast(k);
    });
    closing.clear();
    for (std::size_t k = 0; k < closes.size(); ++k) {
        if (closes[k]) closing.push_back(static_cast<std::int32_t>(k));
    }
}

void GapImpacts::run(const std::vector<std::int32_t>& closing, double h) {
    strikes_.clear();
    first_round_ = ++round_;
    parallel_.runs(closing.size(), k_looks_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) meetings_.foresee_disks(at(closing[n]), 0.0, left_);
    });
    find_strikes(closing, h);
    if (!strikes_.empty()) uses_.assign(now_.contacts->size(), 0);
    while (!strikes_.empty()) {
        ++round_;
        choose_turns(h);
        strike_all(h);
        book();
        look_again(h);
    }
    left_ -= h;
}

/// Of the two bodies of a contact, by their velocities at it [m/s].
double GapImpacts::fastest_of(const GapContact& c) const {
    const auto speed_of = [](const SolverBody& body, double arm) {
        return std::sqrt(body.velocity.squaredNorm()) + std::abs(arm * body.spin);
    };
    const double i = speed_of((*now_.bodies)[at(c.i)], c.arm_ni);
    if (is_wall(c.j)) return std::max(i, std::sqrt(c.wall_velocity.squaredNorm()));
    return std::max(i, speed_of((*now_.bodies)[at(c.j)], c.arm_nj));
}

/// Adds the contact if it strikes.
void GapImpacts::look_at(std::int32_t contact, double h, std::vector<Strike>& found) const {
    const GapContact& c = (*now_.contacts)[at(contact)];
    if (!c.active) return;
    const double speed = -normal_speed(c, *now_.bodies);
    if (speed <= impact_speed_ || speed <= k_no_speed * fastest_of(c)) return;
    if (blow_solver_.meets(contact, speed, h)) found.push_back({speed, contact, c.i, c.j});
}

/// Adds those of the candidates that strike.
void GapImpacts::find_strikes(const std::vector<std::int32_t>& candidates, double h) {
    const std::size_t runs = begin_looks(candidates.size(), k_looks_a_run);
    parallel_.runs(candidates.size(), k_looks_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) look_at(candidates[n], h, found_[first / k_looks_a_run]);
    });
    add_strikes(runs);
}

/// Room for what `count` looks find, in runs of `length`; returns the number of runs.
std::size_t GapImpacts::begin_looks(std::size_t count, std::size_t length) {
    const std::size_t runs = (count + length - 1) / length;
    found_.resize(std::max(found_.size(), runs));
    for (std::size_t run = 0; run < runs; ++run) found_[run].clear();
    return runs;
}

/// What has been found, in order, and each once, however often it was found.
void GapImpacts::add_strikes(std::size_t runs) {
    for (std::size_t run = 0; run < runs; ++run) {
        for (const Strike& strike : found_[run]) {
            std::int64_t& added = added_[at(strike.contact)];
            if (added == round_) continue;
            added = round_;
            strikes_.push_back(strike);
        }
    }
}

/// Those of which neither grain has a contact that closes faster; of equals the first one found.
void GapImpacts::choose_turns(double h) {
    for (const Strike& s : strikes_) {
        for (const BodyIndex body : {s.i, s.j}) {
            if (is_wall(body)) continue;
            OfGrain& grain = grains_[at(body)];
            const bool first = grain.round != round_;
            const BodyIndex partner = body == s.i ? s.j : s.i;
            grain.one_partner = first || (grain.one_partner && grain.partner == partner);
            grain.partner = partner;
            if (first || s.speed > grain.fastest.speed ||
                (s.speed == grain.fastest.speed && s.contact < grain.fastest.contact)) {
                grain.round = round_;
                grain.fastest = s;
            }
        }
    }
    turns_.clear();
    for (const Strike& s : strikes_) {
        if (is_fastest_of(s.i, s) && is_fastest_of(s.j, s)) turns_.push_back({s, time_of(s, h)});
    }
}

bool GapImpacts::is_fastest_of(BodyIndex body, const Strike& strike) const {
    return is_wall(body) || grains_[at(body)].fastest.contact == strike.contact;
}

/// When in this sub-step a body was struck [s]; before, it was not on the path on which it is now.
double GapImpacts::struck_at(BodyIndex body) const {
    if (is_wall(body)) return 0.0;
    const OfGrain& grain = grains_[at(body)];
    return grain.struck >= first_round_ ? grain.time : 0.0;
}

double GapImpacts::earliest(std::int32_t contact) const {
    const GapContact& c = (*now_.contacts)[at(contact)];
    return std::max(struck_at(c.i), struck_at(c.j));
}

/// When in the sub-step a strike takes place [s]: when the bodies meet, where that can be known, else as early as can
/// be.
double GapImpacts::time_of(const Strike& s, double h) const {
    const double from = earliest(s.contact);
    if (is_wall(s.j)) return std::max(from, time_to_wall(s, h));
    const GapContact& c = (*now_.contacts)[at(s.contact)];
    if (!c.between_disks() && !c.met) return from;
    const auto alone = [this](BodyIndex body) { return grains_[at(body)].one_partner && meetings_.flies(body); };
    if (!alone(s.i) || !alone(s.j)) return from;
    return std::clamp(now_.lanes->open(at(s.contact)) / s.speed, from, h);
}

/// Time until a grain reaches its resting gap from a wall at rest [s], no longer than the sub-step; 0 where others are
/// near enough to take part.
double GapImpacts::time_to_wall(const Strike& strike, double h) const {
    const GapContact& c = (*now_.contacts)[at(strike.contact)];
    if (c.wall_velocity != Vec2::Zero()) return 0.0;
    const double way = now_.lanes->open(at(strike.contact));
    if (way <= 0.0) return 0.0;
    for (const std::int32_t k : now_.by_grain->of(c.i)) {
        if (k == strike.contact || !(*now_.contacts)[at(k)].active) continue;
        if (now_.lanes->open(at(k)) < k_alone * strike.speed * h) return 0.0;
    }
    const double root = strike.speed * strike.speed - 2.0 * scene_.gravity.dot(c.normal) * way;
    return root > 0.0 ? std::min(h, 2.0 * way / (strike.speed + std::sqrt(root))) : 0.0;
}

/// Turns that a thread takes at a time: rounds are short, so that they are cut evenly, or not at all.
std::size_t GapImpacts::turns_a_run() const {
    const std::size_t most = k_runs_a_thread * static_cast<std::size_t>(parallel_.threads());
    const std::size_t runs = std::clamp<std::size_t>(turns_.size() / k_impacts_a_run, 1, most);
    return std::max<std::size_t>(1, (turns_.size() + runs - 1) / runs);
}

void GapImpacts::strike_all(double h) {
    blows_.resize(turns_.size());
    if (now_.report->record_impacts) records_.resize(Blow::k_most_pushes * turns_.size());
    const std::size_t length = turns_a_run();
    parallel_.runs(turns_.size(), length, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) strike(n, h);
    });
    // Changes the gaps of all that is near.
    for (const Turn& turn : turns_) {
        if (turn.time > 0.0) lead_back(turn);
    }
}

/// The sub-step kicks by h after all strikes. A grain that meets a wall has had a part of the kick when it does; a pair
/// falls alike, and its impulse knows nothing of it.
void GapImpacts::strike(std::size_t turn, double h) {
    Turn& now = turns_[turn];
    std::vector<SolverBody>& bodies = *now_.bodies;
    const auto [speed, contact, i, j] = now.strike;
    if (is_wall(j)) bodies[at(i)].velocity += now.time * scene_.gravity;
    now.i_before = motion_of(bodies[at(i)]);
    if (!is_wall(j)) now.j_before = motion_of(bodies[at(j)]);
    blows_[turn] = blow_solver_.solve(contact, speed, h);
    for (std::size_t n = 0; n < blows_[turn].count; ++n) push_by(turn, n);
    ++uses_[at(contact)];
    for (const BodyIndex body : {i, j}) {
        if (is_wall(body)) continue;
        grains_[at(body)].struck = round_;
        grains_[at(body)].time = now.time;
    }
}

/// Gives the bodies an impulse of the turn's blow, and keeps a record of it where that is wanted.
void GapImpacts::push_by(std::size_t turn, std::size_t n) {
    std::vector<SolverBody>& bodies = *now_.bodies;
    const BlowPush& p = blows_[turn].pushes[n];
    GapContact& c = (*now_.contacts)[at(p.contact)];
    const bool recorded = now_.report->record_impacts;
    if (recorded) records_[Blow::k_most_pushes * turn + n] = record(p);
    push(c, bodies, p.normal, p.tangential);
    c.total_impulse += p.normal * c.normal + p.tangential * c.tangent();
    if (!recorded) return;
    ImpactRecord& r = records_[Blow::k_most_pushes * turn + n];
    r.closing_after = normal_speed(c, bodies);
    r.sliding_after = tangent_speed(c, bodies);
    r.i_after = motion_of(bodies[at(c.i)]);
    r.j_after = is_wall(c.j) ? r.j_before : motion_of(bodies[at(c.j)]);
}

/// The sub-step moves every grain by h with the velocity that it has in the end. Poses get what the velocity before the
/// blow has moved them more than the one after, so that the path is the exact one: flight, impact, flight. (That keeps
/// the centre of mass of a pair where it is.) Until the impact, the grain is not where its path says.
void GapImpacts::lead_back(const Turn& turn) {
    const auto [speed, contact, i, j] = turn.strike;
    shift(i, turn.i_before, turn.time);
    if (is_wall(j)) {
        (*now_.bodies)[at(i)].velocity -= turn.time * scene_.gravity;
    } else {
        shift(j, turn.j_before, turn.time);
    }
}

void GapImpacts::shift(BodyIndex body, const Motion& before, double time) const {
    const SolverBody& after = (*now_.bodies)[at(body)];
    const Vec2 way = time * (before.velocity - after.velocity);
    const double turned = time * (before.spin - after.spin);
    now_.trial->centre[at(body)] += way;
    now_.trial->angle[at(body)] += turned;
    for (const std::int32_t k : now_.by_grain->of(body)) {
        const GapContact& touched = (*now_.contacts)[at(k)];
        const bool is_i = touched.i == body;
        const double opened = touched.normal.dot(way) + (is_i ? touched.arm_ni : touched.arm_nj) * turned;
        now_.lanes->widen(at(k), is_i ? opened : -opened);
    }
}

/// What is known of an impulse before it acts.
ImpactRecord GapImpacts::record(const BlowPush& p) const {
    const GapContact& c = (*now_.contacts)[at(p.contact)];
    const std::vector<SolverBody>& bodies = *now_.bodies;
    const bool wall = is_wall(c.j);
    ImpactRecord r;
    r.time = now_.time;
    r.step = now_.step;
    r.i = c.i;
    r.j = c.j;
    r.point = c.point;
    r.normal = c.normal;
    r.centre_i = c.point - now_.halfway->arm(c, c.i);
    r.centre_j = wall ? c.point : Vec2(c.point - now_.halfway->arm(c, c.j));
    r.restitution = p.restitution;
    r.friction = c.friction;
    r.mode = p.mode;
    r.impulse_normal = p.normal;
    r.impulse_tangential = p.tangential;
    r.i_before = motion_of(bodies[at(c.i)]);
    r.j_before = wall ? Motion{c.wall_velocity, 0.0} : motion_of(bodies[at(c.j)]);
    r.closing_before = normal_speed(c, bodies);
    r.sliding_before = tangent_speed(c, bodies);
    return r;
}

/// Into the report, in the order of the turns.
void GapImpacts::book() {
    StepReport& report = *now_.report;
    for (std::size_t turn = 0; turn < turns_.size(); ++turn) {
        const Blow& blow = blows_[turn];
        report.ledger.restitution_loss += blow.restitution_loss;
        report.ledger.friction_loss += blow.friction_loss;
        for (std::size_t n = 0; n < blow.count; ++n) {
            const BlowPush& p = blow.pushes[n];
            const GapContact& c = (*now_.contacts)[at(p.contact)];
            take_reaction(c, p.normal * c.normal + p.tangential * c.tangent(), report);
            ++report.impacts;
            if (report.record_impacts) report.impact_records.push_back(records_[Blow::k_most_pushes * turn + n]);
        }
    }
}

/// The strikes of the next round: those of grains that have not been struck, and what strikes now among the others.
void GapImpacts::look_again(double h) {
    std::erase_if(strikes_, [&](const Strike& s) { return is_struck(s.i) || is_struck(s.j); });
    for (const Turn& turn : turns_) {
        for (const BodyIndex body : {turn.strike.i, turn.strike.j}) {
            if (is_wall(body)) continue;
            for (const std::int32_t k : now_.by_grain->of(body)) {
                if (body == turn.strike.j && (*now_.contacts)[at(k)].i == turn.strike.i) continue;  // has been
                if (meetings_.begins_pair(at(k))) meetings_.foresee(at(k), earliest(k), left_);
            }
        }
    }
    const std::size_t length = turns_a_run();
    const std::size_t runs = begin_looks(turns_.size(), length);
    parallel_.runs(turns_.size(), length, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) look_about(turns_[n], h, found_[first / length]);
    });
    add_strikes(runs);
}

/// What strikes now of the contacts of both grains.
void GapImpacts::look_about(const Turn& turn, double h, std::vector<Strike>& found) const {
    for (const BodyIndex body : {turn.strike.i, turn.strike.j}) {
        if (is_wall(body)) continue;
        for (const std::int32_t k : now_.by_grain->of(body)) {
            if (uses_[at(k)] < k_most_impacts) look_at(k, h, found);
        }
    }
}

}  // namespace polargrain
