#include "src/engines/contact/repair.h"

#include <algorithm>

namespace polargrain {

int Repair::run(GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& before, PoseSet& trial) {
    const auto overlapping = [&] {
        return static_cast<int>(std::count_if(detection.pairs().begin(), detection.pairs().end(),
                                              [](const PairContacts& p) { return p.overlapping; }));
    };
    way_.resize(bodies.size());
    turn_.resize(bodies.size());
    int left = overlapping();
    for (int pass = 1; pass <= k_passes && left > 0; ++pass) {
        choose_grains(detection, detection.contacts(), pass);
        solve(detection.contacts(), bodies, trial);
        for (std::size_t k = 0; k < chosen_.size(); ++k) {
            chosen_[k] = way_[k] != Vec2::Zero() || turn_[k] != 0.0 ? 1 : 0;
            if (!chosen_[k]) continue;
            trial.centre[k] += way_[k];
            trial.angle[k] += turn_[k];
            trial.refresh(k);
        }
        detection.detect_moved(before, trial, chosen_);
        left = overlapping();
    }
    return left;
}

void Repair::choose_grains(const GapDetection& detection, const std::vector<GapContact>& contacts, int rings) {
    chosen_.assign(way_.size(), 0);
    for (const PairContacts& pair : detection.pairs()) {
        if (!pair.overlapping) continue;
        chosen_[Grains::at(pair.i)] = 1;
        if (!is_wall(pair.j)) chosen_[Grains::at(pair.j)] = 1;
    }
    for (int ring = 0; ring < rings; ++ring) {
        next_ = chosen_;
        for (const GapContact& c : contacts) {
            if (is_wall(c.j) || c.gap >= k_ring * c.resting) continue;
            if (chosen_[Grains::at(c.i)]) next_[Grains::at(c.j)] = 1;
            if (chosen_[Grains::at(c.j)]) next_[Grains::at(c.i)] = 1;
        }
        chosen_.swap(next_);
    }
}

void Repair::solve(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                   const PoseSet& trial) {
    std::fill(way_.begin(), way_.end(), Vec2::Zero());
    std::fill(turn_.begin(), turn_.end(), 0.0);
    collect_rows(contacts, bodies, trial);
    for (int s = 0; s < k_sweeps; ++s) {
        for (std::size_t m = 0; m < rows_.size(); ++m) {
            Row& row = rows_[s % 2 == 0 ? m : rows_.size() - 1 - m];
            const GapContact& c = contacts[static_cast<std::size_t>(row.contact)];
            double gap = c.gap;
            if (gives_way(c.i)) gap += c.normal.dot(way_[Grains::at(c.i)]) + row.arm_ni * turn_[Grains::at(c.i)];
            if (gives_way(c.j)) gap -= c.normal.dot(way_[Grains::at(c.j)]) + row.arm_nj * turn_[Grains::at(c.j)];
            const double push = std::max(0.0, row.push + row.mass * (row.aim - gap));
            const double change = push - row.push;
            row.push = push;
            if (change == 0.0) continue;
            if (gives_way(c.i)) {
                way_[Grains::at(c.i)] += bodies[Grains::at(c.i)].inverse_mass * change * c.normal;
                turn_[Grains::at(c.i)] += bodies[Grains::at(c.i)].inverse_inertia * change * row.arm_ni;
            }
            if (gives_way(c.j)) {
                way_[Grains::at(c.j)] -= bodies[Grains::at(c.j)].inverse_mass * change * c.normal;
                turn_[Grains::at(c.j)] -= bodies[Grains::at(c.j)].inverse_inertia * change * row.arm_nj;
            }
        }
    }
}

void Repair::collect_rows(const std::vector<GapContact>& contacts, const std::vector<SolverBody>& bodies,
                          const PoseSet& trial) {
    rows_.clear();
    for (std::size_t n = 0; n < contacts.size(); ++n) {
        const GapContact& c = contacts[n];
        if (!gives_way(c.i) && !gives_way(c.j)) continue;
        if (c.gap >= k_near * c.resting) continue;
        Row row{static_cast<std::int32_t>(n), c.gap < k_part * c.resting ? k_part * c.resting : 0.0, 0, 0, 0, 0};
        double inverse = 0.0;
        if (gives_way(c.i)) {
            const SolverBody& i = bodies[Grains::at(c.i)];
            row.arm_ni = cross(Vec2(c.point - trial.centre[Grains::at(c.i)]), c.normal);
            inverse += i.inverse_mass + i.inverse_inertia * row.arm_ni * row.arm_ni;
        }
        if (gives_way(c.j)) {
            const SolverBody& j = bodies[Grains::at(c.j)];
            row.arm_nj = cross(Vec2(c.point - trial.centre[Grains::at(c.j)]), c.normal);
            inverse += j.inverse_mass + j.inverse_inertia * row.arm_nj * row.arm_nj;
        }
        row.mass = 1.0 / inverse;
        rows_.push_back(row);
    }
}

}  // namespace polargrain
