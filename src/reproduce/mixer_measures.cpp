#include "src/reproduce/mixer_measures.h"

#include <cmath>
#include <optional>

namespace polargrain {

std::vector<std::size_t> side_changes(std::span<const double> x, double depth) {
    std::vector<std::size_t> changes;
    double side = 0.0;  // of the last sample that was deep: -1, 1, or 0 before there was one
    std::size_t passed = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (k > 0 && (x[k] > 0.0) != (x[k - 1] > 0.0)) passed = k;
        if (std::abs(x[k]) < depth) continue;
        const double now = x[k] > 0.0 ? 1.0 : -1.0;
        if (side != 0.0 && now != side) changes.push_back(passed);
        side = now;
    }
    return changes;
}

std::vector<double> round_trips(std::span<const double> time, std::span<const double> height, double first,
                                double second) {
    std::vector<double> trips;
    std::optional<double> left;  // when the path last went up through the first level, and has not come back
    bool reached = false;
    for (std::size_t k = 1; k < height.size(); ++k) {
        const bool was_above = height[k - 1] > first, is_above = height[k] > first;
        if (was_above != is_above) {
            const double share = (first - height[k - 1]) / (height[k] - height[k - 1]);
            const double passage = time[k - 1] + share * (time[k] - time[k - 1]);
            if (left && reached) trips.push_back(passage - *left);
            left = is_above ? std::optional{passage} : std::nullopt;
            reached = false;
        }
        if (height[k] >= second) reached = true;
    }
    return trips;
}

double displacement_variance(std::span<const Vec2> displacements) {
    if (displacements.empty()) return 0.0;
    const auto n = static_cast<double>(displacements.size());
    Vec2 mean = Vec2::Zero();
    for (const Vec2& d : displacements) mean += d / n;
    double variance = 0.0;
    for (const Vec2& d : displacements) variance += (d - mean).squaredNorm() / n;
    return variance;
}

std::pair<int, int> CellField::square(const Vec2& place, double side) {
    return {static_cast<int>(std::floor(place.x() / side)), static_cast<int>(std::floor(place.y() / side))};
}

void CellField::add(const Vec2& place, const Vec2& velocity) {
    Sum& sum = sums_[square(place, side_)];
    sum.count += 1.0;
    sum.speed += velocity.norm();
    sum.squares += velocity.squaredNorm();
    sum.velocity += velocity;
}

std::vector<CellField::Cell> CellField::cells() const {
    std::vector<Cell> cells;
    cells.reserve(sums_.size());
    for (const auto& [square, sum] : sums_) {
        const Vec2 mean = sum.velocity / sum.count;
        cells.push_back({.middle = side_ * Vec2(square.first + 0.5, square.second + 0.5),
                         .count = sum.count,
                         .velocity = mean,
                         .speed = sum.speed / sum.count,
                         .temperature = 0.5 * std::max(0.0, sum.squares / sum.count - mean.squaredNorm())});
    }
    return cells;
}

double speed_difference(const std::vector<CellField::Cell>& cells, const std::vector<CellField::Cell>& from) {
    double off = 0.0, all = 0.0;
    auto other = cells.begin();
    for (const CellField::Cell& cell : from) {
        const auto before = [](const CellField::Cell& a, const CellField::Cell& b) {
            return std::pair(a.middle.x(), a.middle.y()) < std::pair(b.middle.x(), b.middle.y());
        };
        while (other != cells.end() && before(*other, cell)) ++other;
        if (other == cells.end() || before(cell, *other)) continue;
        off += cell.count * std::abs(other->speed - cell.speed);
        all += cell.count * cell.speed;
    }
    return off / all;
}

}  // namespace polargrain
