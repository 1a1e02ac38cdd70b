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
        choose_grains(detection, pass);
        solve(detection, bodies, trial);
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

/// The overlapping grains, and as many rings of neighbours that all but touch.
void Repair::choose_grains(const GapDetection& detection, int rings) {
    const std::vector<PairContacts>& pairs = detection.pairs();
    by_grain_.index(pairs, way_.size());
    chosen_.assign(way_.size(), 0);
    edge_.clear();
    const auto choose = [&](BodyIndex body, std::vector<GrainIndex>& list) {
        if (is_wall(body) || chosen_[Grains::at(body)]) return;
        chosen_[Grains::at(body)] = 1;
        list.push_back(body);
    };
    for (const PairContacts& pair : pairs) {
        if (!pair.overlapping) continue;
        choose(pair.i, edge_);
        choose(pair.j, edge_);
    }
    for (int ring = 0; ring < rings; ++ring) {
        next_edge_.clear();
        for (const GrainIndex grain : edge_) {
            for (const std::int32_t n : by_grain_.of(grain)) {
                const PairContacts& pair = pairs[static_cast<std::size_t>(n)];
                const bool near = std::any_of(detection.begin_of(pair), detection.end_of(pair),
                                              [](const GapContact& c) { return c.gap < k_ring * c.resting; });
                if (!near || is_wall(pair.j)) continue;
                choose(pair.i, next_edge_);
                choose(pair.j, next_edge_);
            }
        }
        edge_.swap(next_edge_);
    }
}

void Repair::solve(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial) {
    std::fill(way_.begin(), way_.end(), Vec2::Zero());
    std::fill(turn_.begin(), turn_.end(), 0.0);
    collect_rows(detection, bodies, trial);
    const std::vector<GapContact>& contacts = detection.contacts();
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

void Repair::collect_rows(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial) {
    rows_.clear();
    for (const PairContacts& pair : detection.pairs()) {
        if (!gives_way(pair.i) && !gives_way(pair.j)) continue;
        for (std::int32_t n = pair.first; n < pair.first + pair.count; ++n) add_row(n, detection, bodies, trial);
    }
}

void Repair::add_row(std::int32_t contact, const GapDetection& detection, const std::vector<SolverBody>& bodies,
                     const PoseSet& trial) {
    const GapContact& c = detection.contacts()[static_cast<std::size_t>(contact)];
    if (c.gap >= k_near * c.resting) return;
    Row row{contact, c.gap < k_part * c.resting ? k_part * c.resting : 0.0, 0, 0, 0, 0};
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

}  // namespace polargrain
