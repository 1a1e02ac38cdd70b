#include "src/engines/dem/numbering.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polargrain {

Numbering own_numbers(GrainIndex grains) {
    Numbering numbers(Grains::at(grains));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

Numbering numbers_by_rows(const Grains& grains, double row) {
    const auto extent = [](const std::vector<double>& at) {
        const auto [least, most] = std::minmax_element(at.begin(), at.end());
        return *most - *least;
    };
    Numbering numbers = own_numbers(grains.size());
    if (numbers.empty()) return numbers;
    const bool wide = extent(grains.x) > extent(grains.y);
    const std::vector<double>& across = wide ? grains.x : grains.y;
    const std::vector<double>& along = wide ? grains.y : grains.x;
    std::vector<double> rows;
    for (const double at : across) rows.push_back(std::floor(at / row));
    std::stable_sort(numbers.begin(), numbers.end(), [&](GrainIndex a, GrainIndex b) {
        const std::size_t i = Grains::at(a);
        const std::size_t j = Grains::at(b);
        return rows[i] != rows[j] ? rows[i] < rows[j] : along[i] < along[j];
    });
    return numbers;
}

Numbering places_of(const Numbering& numbers) {
    Numbering places(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) places[Grains::at(numbers[k])] = static_cast<GrainIndex>(k);
    return places;
}

void move_coordinates(const Numbering& from, const Numbering& to, std::vector<double>& values) {
    if (values.empty()) return;
    const Numbering places = places_of(from);
    const std::vector<double> before = values;
    const std::size_t size = 3 * from.size();
    for (std::size_t first = values.size() % size; first < values.size(); first += size) {
        for (std::size_t k = 0; k < to.size(); ++k) {
            const std::size_t old = Grains::at(places[Grains::at(to[k])]);
            for (std::size_t d = 0; d < 3; ++d) values[first + 3 * k + d] = before[first + 3 * old + d];
        }
    }
}

const std::vector<std::uint32_t>& PairSorter::sort(std::span<const Pair> pairs, std::size_t walls, std::size_t grains) {
    order_.resize(pairs.size());
    sorted_.resize(pairs.size());
    std::iota(order_.begin(), order_.end(), 0);
    start_.resize(walls + grains + 1);
    sort_by([&](std::uint32_t k) { return pairs[k].second; }, walls);
    sort_by([&](std::uint32_t k) { return pairs[k].first; }, walls);
    return order_;
}

template <typename BodyOf>
void PairSorter::sort_by(BodyOf body_of, std::size_t walls) {
    const auto bucket = [&](std::uint32_t k) {
        return static_cast<std::size_t>(std::int64_t{body_of(k)} + static_cast<std::int64_t>(walls));
    };
    std::fill(start_.begin(), start_.end(), 0);
    for (const std::uint32_t k : order_) ++start_[bucket(k) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    for (const std::uint32_t k : order_) sorted_[start_[bucket(k)]++] = k;
    order_.swap(sorted_);
}

}  // namespace polargrain
