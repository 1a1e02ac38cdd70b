#include "src/engines/contact/position_correction.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/gap_motion.h"

namespace polargrain {

bool PositionCorrection::needed(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                const Pace& pace) {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const GapContact& c) { return too_near(c, bodies, pace); });
}

bool PositionCorrection::too_near(const GapContact& c, const std::vector<SolverBody>& bodies, const Pace& pace) {
    if (!c.active || c.gap >= k_trigger * c.resting) return false;
    const double way = pace.dt * (std::abs(normal_speed(c, bodies)) + std::abs(tangent_speed(c, bodies)));
    const double stir = std::min(1.0, way / (k_stir * c.resting));
    const double still = c.friction > 0.0 ? pace.still : std::max(pace.still, k_still_smooth);
    return c.gap < (still + (k_trigger - still) * stir) * c.resting;
}

double PositionCorrection::correct(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                                   const Vec2& gravity, const Pace& pace, double budget, PoseSet& trial) {
    if (budget <= 0.0 || !needed(contacts, bodies, pace)) return 0.0;
    collect_rows(contacts, bodies, pace);
    shift_.assign(bodies.size(), Shift{});
    for (int s = 0; s < k_sweeps; ++s) {
        for (std::size_t m = 0; m < rows_.size(); ++m) {
            Row& row = rows_[s % 2 == 0 ? m : rows_.size() - 1 - m];
            open(row, contacts[static_cast<std::size_t>(row.contact)], bodies);
        }
    }
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
                                      const Pace& pace) {
    rows_.clear();
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const GapContact& c = contacts[k];
        if (!c.active || c.gap >= k_look * c.resting) continue;
        const double aim =
            too_near(c, bodies, pace) ? c.gap + k_part * (c.resting - c.gap) : std::min(c.gap, k_trigger * c.resting);
        rows_.push_back({static_cast<std::int32_t>(k), aim, 0.0});
    }
}

void PositionCorrection::open(Row& row, const GapContact& c, const std::vector<SolverBody>& bodies) {
    Shift& i = shift_[Grains::at(c.i)];
    double gap = c.gap + c.normal.dot(i.way) + c.arm_ni * i.turn;
    if (!is_wall(c.j)) {
        const Shift& j = shift_[Grains::at(c.j)];
        gap -= c.normal.dot(j.way) + c.arm_nj * j.turn;
    }
    const double push = std::max(0.0, row.push + c.mass_n * (row.aim - gap));
    const double change = push - row.push;
    row.push = push;
    if (change == 0.0) return;
    i.way += bodies[Grains::at(c.i)].inverse_mass * change * c.normal;
    i.turn += bodies[Grains::at(c.i)].inverse_inertia * change * c.arm_ni;
    if (is_wall(c.j)) return;
    Shift& j = shift_[Grains::at(c.j)];
    j.way -= bodies[Grains::at(c.j)].inverse_mass * change * c.normal;
    j.turn -= bodies[Grains::at(c.j)].inverse_inertia * change * c.arm_nj;
}

}  // namespace polargrain
