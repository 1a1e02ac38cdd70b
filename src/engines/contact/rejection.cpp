#include "src/engines/contact/rejection.h"

#include <algorithm>

#include "src/detect/overlap.h"

namespace polargrain {

int Rejection::run(GapDetection& detection, const PoseSet& before, PoseSet& trial, std::vector<SolverBody>& bodies) {
    rejected_.assign(bodies.size(), 0);
    for (int round = 0; round < k_rounds && detection.overlapping() > 0; ++round) {
        find(detection, before, trial);
        const std::vector<char>& stays = update_.decide(found_);
        bool any = false;
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            if (!stays[k] || rejected_[k]) continue;
            any = true;
            rejected_[k] = 1;
            SolverBody& body = bodies[k];
            body.velocity = Vec2::Zero();
            body.spin = 0.0;
            body.touched = true;
            trial.centre[k] = before.centre[k];
            trial.angle[k] = before.angle[k];
            trial.refresh(k);
        }
        if (!any) break;
        detection.detect_moved(before, trial, rejected_);
    }
    return static_cast<int>(std::count(rejected_.begin(), rejected_.end(), 1));
}

void Rejection::find(const GapDetection& detection, const PoseSet& before, const PoseSet& trial) {
    found_.conflicts.clear();
    found_.order.clear();
    found_.blocked.assign(trial.pose.size(), 0);
    for (const PairContacts& pair : detection.pairs()) {
        if (!pair.overlapping) continue;
        if (is_wall(pair.j)) {
            found_.blocked[Grains::at(pair.i)] = 1;
        } else {
            found_.conflicts.emplace_back(pair.j, pair.i);
        }
    }
    for (const auto& [a, b] : detection.near_pairs()) {
        const std::size_t i = Grains::at(a);
        const std::size_t j = Grains::at(b);
        const Shape& shape_a = scene_.shape_of(a);
        const Shape& shape_b = scene_.shape_of(b);
        if (overlap(shape_a, before.pose[i], shape_b, trial.pose[j])) found_.order.emplace_back(a, b);
        if (overlap(shape_a, trial.pose[i], shape_b, before.pose[j])) found_.order.emplace_back(b, a);
    }
}

}  // namespace polargrain
