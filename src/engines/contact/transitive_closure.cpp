#include "src/engines/contact/transitive_closure.h"

#include <bit>

namespace polargrain {

WarshallClosure::WarshallClosure(GrainIndex grains, const std::vector<MoveOrder>& order)
    : words_((static_cast<std::size_t>(grains) + 63) / 64), bits_(words_ * static_cast<std::size_t>(grains), 0) {
    const auto n = static_cast<std::size_t>(grains);
    const auto bit = [](std::size_t column) { return std::uint64_t{1} << (column % 64); };
    for (const auto& [a, b] : order) bits_[Grains::at(a) * words_ + Grains::at(b) / 64] |= bit(Grains::at(b));
    for (std::size_t middle = 0; middle < n; ++middle) {
        for (std::size_t a = 0; a < n; ++a) {
            if (!(bits_[a * words_ + middle / 64] & bit(middle))) continue;
            for (std::size_t w = 0; w < words_; ++w) bits_[a * words_ + w] |= bits_[middle * words_ + w];
        }
    }
}

std::vector<std::uint64_t>::const_iterator WarshallClosure::row(GrainIndex a) const {
    return bits_.begin() + static_cast<std::ptrdiff_t>(Grains::at(a) * words_);
}

bool WarshallClosure::related(GrainIndex a, GrainIndex b) const {
    return (*(row(a) + b / 64) >> (Grains::at(b) % 64) & 1U) != 0;
}

int WarshallClosure::dependants(GrainIndex a) const {
    int count = 0;
    for (auto word = row(a); word != row(a) + static_cast<std::ptrdiff_t>(words_); ++word)
        count += std::popcount(*word);
    return count - (related(a, a) ? 1 : 0);
}

void ReachCount::build(GrainIndex grains, const std::vector<MoveOrder>& order) {
    const auto n = static_cast<std::size_t>(grains);
    first_.assign(n + 1, 0);
    for (const auto& [a, b] : order) ++first_[Grains::at(a) + 1];
    for (std::size_t k = 0; k < n; ++k) first_[k + 1] += first_[k];
    fill_.assign(first_.begin(), first_.end() - 1);
    next_.resize(order.size());
    for (const auto& [a, b] : order) next_[static_cast<std::size_t>(fill_[Grains::at(a)]++)] = b;
    count_.assign(n, -1);
    seen_.assign(n, 0);
    stamp_ = 0;
}

int ReachCount::dependants(GrainIndex a) {
    std::int32_t& known = count_[Grains::at(a)];
    if (known >= 0) return known;
    ++stamp_;
    queue_.assign(1, a);
    seen_[Grains::at(a)] = stamp_;
    for (std::size_t head = 0; head < queue_.size(); ++head) {
        for_each_direct(queue_[head], [this](GrainIndex b) {
            if (seen_[Grains::at(b)] == stamp_) return;
            seen_[Grains::at(b)] = stamp_;
            queue_.push_back(b);
        });
    }
    known = static_cast<std::int32_t>(queue_.size()) - 1;
    return known;
}

}  // namespace polargrain
