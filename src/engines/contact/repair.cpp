#include "src/engines/contact/repair.h"

#include <algorithm>

namespace polargrain {

namespace {

/// A grain of the row that gives way.
GrainIndex grain_of(const GapOpening& row) { return row.i.grain >= 0 ? row.i.grain : row.j.grain; }

}  // namespace

Repair::Repair(const Scene& scene)
    : parallel_(std::max(1, scene.threads)),
      chosen_(static_cast<std::size_t>(scene.grains.size()), 0),
      parent_(chosen_.size(), 0),
      island_of_(chosen_.size(), 0),
      shift_(chosen_.size()) {}

int Repair::run(GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& before, PoseSet& trial,
                int sweeps) {
    int left = detection.overlapping();
    for (int pass = 1; pass <= k_passes && left > 0; ++pass) {
        choose_grains(detection, pass);
        solve(detection, bodies, trial, sweeps);
        move_chosen(trial);
        detection.detect_moved(before, trial, chosen_);
        left = detection.overlapping();
    }
    return left;
}

/// The overlapping grains, and as many rings of neighbours that all but touch.
void Repair::choose_grains(const GapDetection& detection, int rings) {
    const std::vector<PairContacts>& pairs = detection.pairs();
    by_grain_.index(pairs, chosen_.size());
    std::fill(chosen_.begin(), chosen_.end(), 0);
    grains_.clear();
    for (const PairContacts& pair : pairs) {
        if (!pair.overlapping) continue;
        choose(pair.i);
        choose(pair.j);
    }
    std::size_t first = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const std::size_t last = grains_.size();
        for (; first < last; ++first) {
            for (const std::int32_t n : by_grain_.of(grains_[first])) {
                const PairContacts& pair = pairs[static_cast<std::size_t>(n)];
                if (is_wall(pair.j) || (chosen_[Grains::at(pair.i)] && chosen_[Grains::at(pair.j)])) continue;
                const double near = k_ring * detection.resting_gap(pair.i, pair.j);
                const auto points = detection.points_of(pair);
                if (std::none_of(points.begin(), points.end(), [=](const GapPoint& p) { return p.gap < near; })) {
                    continue;
                }
                choose(pair.i);
                choose(pair.j);
            }
        }
    }
}

void Repair::choose(BodyIndex body) {
    if (is_wall(body) || chosen_[Grains::at(body)]) return;
    chosen_[Grains::at(body)] = 1;
    grains_.push_back(body);
}

/// Moves what has been shifted; only that is still chosen afterwards.
void Repair::move_chosen(PoseSet& trial) {
    for (const GrainIndex grain : grains_) {
        const std::size_t k = Grains::at(grain);
        chosen_[k] = shift_[k].way != Vec2::Zero() || shift_[k].turn != 0.0 ? 1 : 0;
        if (!chosen_[k]) continue;
        trial.centre[k] += shift_[k].way;
        trial.angle[k] += shift_[k].turn;
        trial.refresh(k);
    }
}

void Repair::solve(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial,
                   int sweeps) {
    constexpr std::size_t k_islands_a_run = 8;
    for (const GrainIndex grain : grains_) shift_[Grains::at(grain)] = {};
    collect_rows(detection, bodies, trial);
    part_islands();
    parallel_.runs(islands_.size(), k_islands_a_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) solve_island(islands_[k], sweeps);
    });
}

/// Rows by island, in each in the order in which they were collected.
void Repair::part_islands() {
    for (const GrainIndex grain : grains_) parent_[Grains::at(grain)] = grain;
    for (const GapOpening& row : rows_) {
        if (row.i.grain < 0 || row.j.grain < 0) continue;
        const GrainIndex p = root_of(row.i.grain);
        const GrainIndex q = root_of(row.j.grain);
        parent_[Grains::at(std::max(p, q))] = std::min(p, q);
    }
    for (const GrainIndex grain : grains_) island_of_[Grains::at(grain)] = -1;
    islands_.clear();
    for (const GapOpening& row : rows_) {
        std::int32_t& island = island_of_[Grains::at(root_of(grain_of(row)))];
        if (island < 0) {
            island = static_cast<std::int32_t>(islands_.size());
            islands_.push_back({0, 0});
        }
        ++islands_[static_cast<std::size_t>(island)].last;
    }
    std::size_t end = 0;
    for (Island& island : islands_) {
        const std::size_t size = island.last;
        island = {end, end};
        end += size;
    }
    sorted_.resize(rows_.size());
    for (const GapOpening& row : rows_) {
        Island& island = islands_[static_cast<std::size_t>(island_of_[Grains::at(root_of(grain_of(row)))])];
        sorted_[island.last++] = row;
    }
}

GrainIndex Repair::root_of(GrainIndex grain) {
    while (parent_[Grains::at(grain)] != grain) {
        parent_[Grains::at(grain)] = parent_[Grains::at(parent_[Grains::at(grain)])];
        grain = parent_[Grains::at(grain)];
    }
    return grain;
}

/// Sweeps to and fro until one has changed nothing.
void Repair::solve_island(const Island& island, int sweeps) {
    const std::size_t count = island.last - island.first;
    for (int s = 0; s < sweeps; ++s) {
        bool changed = false;
        for (std::size_t m = 0; m < count; ++m) {
            changed |= sorted_[s % 2 == 0 ? island.first + m : island.last - 1 - m].relax(shift_);
        }
        if (!changed) return;
    }
}

void Repair::collect_rows(const GapDetection& detection, const std::vector<SolverBody>& bodies, const PoseSet& trial) {
    // Each pair once: with i where it gives way, else with j.
    chosen_pairs_.clear();
    for (const GrainIndex grain : grains_) {
        for (const std::int32_t n : by_grain_.of(grain)) {
            const PairContacts& pair = detection.pairs()[static_cast<std::size_t>(n)];
            if (pair.i == grain || !gives_way(pair.i)) chosen_pairs_.push_back(n);
        }
    }
    std::sort(chosen_pairs_.begin(), chosen_pairs_.end());
    rows_.clear();
    for (const std::int32_t n : chosen_pairs_) {
        const PairContacts& pair = detection.pairs()[static_cast<std::size_t>(n)];
        const double resting = detection.resting_gap(pair.i, pair.j);
        for (const GapPoint& p : detection.points_of(pair)) add_row(pair, p, resting, bodies, trial);
    }
}

void Repair::add_row(const PairContacts& pair, const GapPoint& p, double resting, const std::vector<SolverBody>& bodies,
                     const PoseSet& trial) {
    if (p.gap >= k_near * resting) return;
    double inverse = 0.0;
    const auto side = [&](BodyIndex body) {
        if (!gives_way(body)) return OpeningSide{};
        const SolverBody& b = bodies[Grains::at(body)];
        const double arm = cross(Vec2(p.point - trial.centre[Grains::at(body)]), p.normal);
        inverse += b.inverse_mass + b.inverse_inertia * arm * arm;
        return OpeningSide::of(body, b, p.normal, arm);
    };
    const double aim = (p.gap < k_tight * resting ? k_opened : k_least) * resting;
    GapOpening row{p.normal, p.gap, aim, 0.0, 0.0, side(pair.i), side(pair.j)};
    row.mass = 1.0 / inverse;
    rows_.push_back(row);
}

}  // namespace polargrain
