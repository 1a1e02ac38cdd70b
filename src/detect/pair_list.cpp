#include "src/detect/pair_list.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

/// Grains that a thread takes at a time.
constexpr std::size_t k_run = 1024;

}  // namespace

PairList::PairList(const Scene& scene) : parallel_(std::max(1, scene.threads)), search_(parallel_.threads()) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) radii_.push_back(outer_radius(scene.shape_of(k)));
}

PairList::PairList(std::vector<double> radii) : parallel_(1), radii_(std::move(radii)) {}

bool PairList::update(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance) {
    const auto clear = [clearance](std::size_t k) { return clearance.empty() ? 0.0 : clearance[k]; };
    const auto out_of_margin = [&](std::size_t k) {
        const double margin = std::max(0.0, margin_[k] - clear(k));
        return !(std::max((from[k].centre - built_at_[k]).squaredNorm(), (to[k].centre - built_at_[k]).squaredNorm()) <
                 margin * margin);
    };
    if (built_at_.size() == from.size() && !parallel_.any(from.size(), k_run, out_of_margin)) return false;

    built_at_.resize(from.size());
    margin_.resize(from.size());
    circles_.clear();
    for (std::size_t k = 0; k < from.size(); ++k) {
        // One fast grain must not have the list of all others made anew in every step.
        const double way = std::sqrt((to[k].centre - from[k].centre).squaredNorm());
        margin_[k] = std::max(k_margin * radii_[k] + clear(k), k_ways_ahead * way + clear(k));
        built_at_[k] = to[k].centre;
        circles_.push_back({to[k].centre, radii_[k] + margin_[k]});
    }
    search_.find_pairs(circles_, pairs_);
    return true;
}

}  // namespace polargrain
