#include "src/engines/contact/position_correction.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_motion.h"

namespace polargrain {

bool PositionCorrection::needed(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                const Pace& pace) const {
    return parallel_.any(contacts.size(), k_run, [&](std::size_t k) { return too_near(contacts[k], bodies, pace); });
}

bool PositionCorrection::too_near(const GapContact& c, const std::vector<SolverBody>& bodies, const Pace& pace) {
    if (!c.active || c.gap >= k_trigger * c.resting) return false;
    const double way = pace.dt * (std::abs(normal_speed(c, bodies)) + std::abs(tangent_speed(c, bodies)));
    const double stir = std::min(1.0, way / (k_stir * c.resting));
    const double still = c.friction > 0.0 ? pace.still : std::max(pace.still, k_still_smooth);
    return c.gap < (still + (k_trigger - still) * stir) * c.resting;
}

double PositionCorrection::correct(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                   const Vec2& gravity, const Pace& pace, double budget, const ContactLanes& lanes,
                                   PoseSet& trial) {
    if (budget <= 0.0 || !needed(contacts, bodies, pace)) return 0.0;
    collect_rows(contacts, bodies, pace, lanes);
    shift_.assign(bodies.size(), Shift{});
    for (int s = 0; s < k_sweeps; ++s) {
        const bool backwards = s % 2 != 0;
        lanes.each_group(backwards, [&](std::size_t group) { relax(group, backwards); });
    }
    hold_back();
    double lift = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) lift -= gravity.dot(shift_[k].way) / bodies[k].inverse_mass;
    const double part = lift > budget ? budget / lift : 1.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        trial.centre[k] += part * shift_[k].way;
        trial.angle[k] += part * shift_[k].turn;
    }
    return part * lift;
}

void PositionCorrection::collect_rows(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                      const Pace& pace, const ContactLanes& lanes) {
    takes_part_.resize(contacts.size());
    parallel_.runs(contacts.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const GapContact& c = contacts[k];
            takes_part_[k] = c.active && c.gap < k_look * c.resting;
        }
    });
    end_.assign(lanes.groups() + 1, 0);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        if (takes_part_[k]) ++end_[lanes.group_of(k) + 1];
    }
    for (std::size_t g = 1; g < end_.size(); ++g) end_[g] += end_[g - 1];
    in_order_.resize(end_.back());
    // As each group is filled, where it begins becomes where it ends.
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        if (takes_part_[k]) in_order_[end_[lanes.group_of(k)]++] = static_cast<std::int32_t>(k);
    }
    rows_.resize(in_order_.size());
    parallel_.runs(rows_.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            const GapContact& c = contacts[static_cast<std::size_t>(in_order_[n])];
            const double aim = too_near(c, bodies, pace) ? c.gap + k_part * (c.resting - c.gap)
                                                         : std::min(c.gap, k_trigger * c.resting);
            const OpeningSide i = OpeningSide::of(c.i, bodies[Grains::at(c.i)], c.normal, c.arm_ni);
            const OpeningSide j =
                is_wall(c.j) ? OpeningSide{} : OpeningSide::of(c.j, bodies[Grains::at(c.j)], c.normal, c.arm_nj);
            rows_[n] = {c.normal, c.gap, aim, c.mass_n, 0.0, i, j};
        }
    });
}

void PositionCorrection::relax(std::size_t group, bool backwards) {
    const std::size_t first = group > 0 ? end_[group - 1] : 0;
    const std::size_t last = end_[group];
    for (std::size_t m = 0; m < last - first; ++m) rows_[backwards ? last - 1 - m : first + m].relax(shift_);
}

/// Few sweeps push pairs into overlap where a row between walls has no room to give. These stay, and so do those that
/// would now be pushed into them.
void PositionCorrection::hold_back() {
    while (parallel_.any(rows_.size(), k_run, [&](std::size_t n) { return rows_[n].overlaps(shift_); })) {
        for (const GapOpening& row : rows_) row.hold(shift_);
    }
}

}  // namespace polargrain
