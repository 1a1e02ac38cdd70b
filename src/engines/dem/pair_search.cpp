#include "src/engines/dem/pair_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

constexpr std::int32_t k_none = -1;

bool circles_meet(const BoundingCircle& a, const BoundingCircle& b) {
    const double reach = a.radius + b.radius;
    return (a.centre - b.centre).squaredNorm() < reach * reach;
}

}  // namespace

void find_pairs_directly(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs) {
    pairs.clear();
    for (std::size_t a = 0; a < circles.size(); ++a) {
        for (std::size_t b = a + 1; b < circles.size(); ++b) {
            if (circles_meet(circles[a], circles[b])) {
                pairs.emplace_back(static_cast<GrainIndex>(a), static_cast<GrainIndex>(b));
            }
        }
    }
}

std::size_t NbsSearch::enter_rows(std::span<const BoundingCircle> circles) {
    const std::size_t n = circles.size();
    Vec2 low = circles[0].centre;
    Vec2 high = low;
    double largest = 0.0;
    for (const BoundingCircle& c : circles) {
        low = low.cwiseMin(c.centre);
        high = high.cwiseMax(c.centre);
        largest = std::max(largest, c.radius);
    }
    // Grains that have flown far away would ask for cells without end: coarser cells only cost time.
    const double extent = (high - low).maxCoeff();
    const double cell = std::max(2.0 * largest, extent / (4.0 * static_cast<double>(n) + 64.0));
    column_.resize(n);
    row_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        column_[k] = static_cast<std::int32_t>((circles[k].centre.x() - low.x()) / cell);
        row_[k] = static_cast<std::int32_t>((circles[k].centre.y() - low.y()) / cell);
    }
    const auto columns = static_cast<std::size_t>((high.x() - low.x()) / cell) + 1;
    const auto rows = static_cast<std::size_t>((high.y() - low.y()) / cell) + 1;
    row_head_.assign(rows, k_none);
    row_done_.assign(rows, 0);
    next_in_row_.assign(n, k_none);
    for (int layer = 0; layer < 2; ++layer) {
        column_head_[layer].assign(columns, k_none);
        next_in_column_[layer].assign(n, k_none);
    }
    for (std::size_t k = 0; k < n; ++k) {
        std::int32_t& head = row_head_[static_cast<std::size_t>(row_[k])];
        next_in_row_[k] = head;
        head = static_cast<std::int32_t>(k);
    }
    return columns;
}

void NbsSearch::find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs) {
    pairs.clear();
    if (circles.size() < 2) return;
    const std::size_t columns = enter_rows(circles);
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const auto row = static_cast<std::size_t>(row_[k]);
        if (row_done_[row] != 0) continue;
        row_done_[row] = 1;
        enter_columns(row, 0);
        if (row > 0) enter_columns(row - 1, 1);
        for (std::int32_t self = row_head_[row]; self != k_none; self = next_in_row_[static_cast<std::size_t>(self)]) {
            const auto column = static_cast<std::size_t>(column_[static_cast<std::size_t>(self)]);
            const auto meet_list = [&](std::int32_t other, int layer) {
                for (; other != k_none; other = next_in_column_[layer][static_cast<std::size_t>(other)]) {
                    meet(circles, self, other, pairs);
                }
            };
            // Its own cell from itself on, the cell on the left, and the three below.
            meet_list(next_in_column_[0][static_cast<std::size_t>(self)], 0);
            if (column > 0) meet_list(column_head_[0][column - 1], 0);
            if (column > 0) meet_list(column_head_[1][column - 1], 1);
            meet_list(column_head_[1][column], 1);
            if (column + 1 < columns) meet_list(column_head_[1][column + 1], 1);
        }
        leave_columns(row, 0);
        if (row > 0) leave_columns(row - 1, 1);
    }
    std::sort(pairs.begin(), pairs.end());
}

void NbsSearch::enter_columns(std::size_t row, int layer) {
    for (std::int32_t k = row_head_[row]; k != k_none; k = next_in_row_[static_cast<std::size_t>(k)]) {
        std::int32_t& head = column_head_[layer][static_cast<std::size_t>(column_[static_cast<std::size_t>(k)])];
        next_in_column_[layer][static_cast<std::size_t>(k)] = head;
        head = k;
    }
}

// Only the heads that were used: clearing whole arrays for each row would cost rows x columns.
void NbsSearch::leave_columns(std::size_t row, int layer) {
    for (std::int32_t k = row_head_[row]; k != k_none; k = next_in_row_[static_cast<std::size_t>(k)]) {
        column_head_[layer][static_cast<std::size_t>(column_[static_cast<std::size_t>(k)])] = k_none;
    }
}

void NbsSearch::meet(std::span<const BoundingCircle> circles, std::int32_t self, std::int32_t other,
                     std::vector<GrainPair>& pairs) const {
    if (circles_meet(circles[static_cast<std::size_t>(self)], circles[static_cast<std::size_t>(other)])) {
        pairs.emplace_back(std::min(self, other), std::max(self, other));
    }
}

std::uint32_t CgridSearch::bucket_of(std::int64_t x, std::int64_t y) const {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(y)) * 0xC2B2AE3D27D4EB4FULL;
    return static_cast<std::uint32_t>(h >> 32) & (static_cast<std::uint32_t>(start_.size()) - 2);
}

std::uint32_t CgridSearch::sort_by_bucket() {
    const std::uint32_t buckets = std::bit_ceil(static_cast<std::uint32_t>(2 * entries_.size()));
    start_.assign(buckets + 1, 0);
    for (const Entry& e : entries_) ++start_[bucket_of(e.x, e.y) + 1];
    for (std::uint32_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
    fill_.assign(start_.begin(), start_.end() - 1);
    sorted_.resize(entries_.size());
    for (const Entry& e : entries_) sorted_[static_cast<std::size_t>(fill_[bucket_of(e.x, e.y)]++)] = e;
    return buckets;
}

void CgridSearch::find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs) {
    pairs.clear();
    if (circles.size() < 2) return;
    double mean = 0.0;
    for (const BoundingCircle& c : circles) mean += c.radius;
    const double cell = k_cell_in_diameters * 2.0 * mean / static_cast<double>(circles.size());
    const auto cell_of = [cell](double at) { return static_cast<std::int64_t>(std::floor(at / cell)); };
    entries_.clear();
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const auto& [centre, radius] = circles[k];
        for (std::int64_t y = cell_of(centre.y() - radius); y <= cell_of(centre.y() + radius); ++y) {
            for (std::int64_t x = cell_of(centre.x() - radius); x <= cell_of(centre.x() + radius); ++x) {
                entries_.push_back({x, y, static_cast<GrainIndex>(k)});
            }
        }
    }
    const std::uint32_t buckets = sort_by_bucket();
    for (std::uint32_t b = 0; b < buckets; ++b) {
        for (std::int32_t i = start_[b]; i < start_[b + 1]; ++i) {
            const Entry& first = sorted_[static_cast<std::size_t>(i)];
            const BoundingCircle& circle = circles[static_cast<std::size_t>(first.circle)];
            for (std::int32_t j = i + 1; j < start_[b + 1]; ++j) {
                const Entry& second = sorted_[static_cast<std::size_t>(j)];
                if (second.x != first.x || second.y != first.y) continue;
                const BoundingCircle& other = circles[static_cast<std::size_t>(second.circle)];
                const double left = std::max(circle.centre.x() - circle.radius, other.centre.x() - other.radius);
                const double bottom = std::max(circle.centre.y() - circle.radius, other.centre.y() - other.radius);
                if (cell_of(left) != first.x || cell_of(bottom) != first.y || !circles_meet(circle, other)) continue;
                pairs.emplace_back(std::min(first.circle, second.circle), std::max(first.circle, second.circle));
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
}

void PairFinder::find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs) {
    switch (search_) {
        case PairSearch::direct: find_pairs_directly(circles, pairs); return;
        case PairSearch::verlet: hierarchy_.find_pairs(circles, pairs); return;
        case PairSearch::nbs: nbs_.find_pairs(circles, pairs); return;
        case PairSearch::cgrid: cgrid_.find_pairs(circles, pairs); return;
    }
}

}  // namespace polargrain
