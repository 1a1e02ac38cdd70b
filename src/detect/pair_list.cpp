#include "src/detect/pair_list.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

/// Grains that a thread takes at a time.
constexpr std::size_t k_run = 1024;

double clear(std::span<const double> clearance, std::size_t k) { return clearance.empty() ? 0.0 : clearance[k]; }

}  // namespace

PairList::PairList(const Scene& scene) : parallel_(std::max(1, scene.threads)), search_(parallel_.threads()) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) radii_.push_back(outer_radius(scene.shape_of(k)));
}

PairList::PairList(std::vector<double> radii) : parallel_(1), radii_(std::move(radii)) {}

/// Which grains are, at either end of their way, farther than their margin from where their pairs were found.
void PairList::find_left(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance) {
    has_left_.resize(from.size());
    parallel_.runs(from.size(), k_run, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            const double margin = std::max(0.0, margin_[k] - clear(clearance, k));
            has_left_[k] = !(std::max((from[k].centre - built_at_[k]).squaredNorm(),
                                      (to[k].centre - built_at_[k]).squaredNorm()) < margin * margin);
        }
    });
    left_.clear();
    for (std::size_t k = 0; k < has_left_.size(); ++k) {
        if (has_left_[k]) left_.push_back(static_cast<GrainIndex>(k));
    }
}

/// The circle within which a grain wants to know of others, where it goes.
void PairList::draw_circle(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance,
                           std::size_t k) {
    // One fast grain must not have its pairs found anew in every step.
    const double way = std::sqrt((to[k].centre - from[k].centre).squaredNorm());
    margin_[k] = std::max(k_margin * radii_[k], k_ways_ahead * way) + clear(clearance, k);
    built_at_[k] = to[k].centre;
    circles_[k] = {to[k].centre, radii_[k] + margin_[k]};
}

bool PairList::update(std::span<const Pose> from, std::span<const Pose> to, std::span<const double> clearance) {
    const bool made = built_at_.size() == from.size();
    if (made) {
        find_left(from, to, clearance);
        if (left_.empty()) return false;
        if (k_few * (search_.loose() + left_.size()) <= from.size()) {
            for (const GrainIndex k : left_) draw_circle(from, to, clearance, Grains::at(k));
            search_.renew_pairs(circles_, left_, pairs_);
            return true;
        }
    }
    built_at_.resize(from.size());
    margin_.resize(from.size());
    circles_.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) draw_circle(from, to, clearance, k);
    search_.find_pairs(circles_, pairs_);
    return true;
}

}  // namespace polargrain
