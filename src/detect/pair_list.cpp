#include "src/detect/pair_list.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

PairList::PairList(std::vector<double> radii) : radii_(std::move(radii)) {}

bool PairList::update(std::span<const Vec2> from, std::span<const Vec2> to) {
    bool valid = built_at_.size() == from.size();
    for (std::size_t k = 0; valid && k < from.size(); ++k) {
        const double margin = k_margin * radii_[k];
        valid =
            std::max((from[k] - built_at_[k]).squaredNorm(), (to[k] - built_at_[k]).squaredNorm()) < margin * margin;
    }
    if (valid) return false;

    built_at_.assign(from.begin(), from.end());
    circles_.clear();
    for (std::size_t k = 0; k < from.size(); ++k) {
        // A grain faster than its margin gets the room that this step needs.
        const double move = std::sqrt((to[k] - from[k]).squaredNorm());
        circles_.push_back({from[k], radii_[k] + std::max(k_margin * radii_[k], move)});
    }
    search_.find_pairs(circles_, pairs_);
    return true;
}

}  // namespace polargrain
