#include "src/detect/pair_list.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

PairList::PairList(const Scene& scene) : search_(std::max(1, scene.threads)) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) radii_.push_back(outer_radius(scene.shape_of(k)));
}

PairList::PairList(std::vector<double> radii) : radii_(std::move(radii)) {}

bool PairList::update(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance) {
    const auto clear = [clearance](std::size_t k) { return clearance.empty() ? 0.0 : clearance[k]; };
    bool valid = built_at_.size() == from.size();
    for (std::size_t k = 0; valid && k < from.size(); ++k) {
        const double margin = std::max(0.0, margin_[k] - clear(k));
        valid = std::max((from[k].centre - built_at_[k]).squaredNorm(), (to[k].centre - built_at_[k]).squaredNorm()) <
                margin * margin;
    }
    if (valid) return false;

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
