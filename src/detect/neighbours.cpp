#include "src/detect/neighbours.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace polargrain {

namespace {

/// Circles that a thread takes at a time.
constexpr std::size_t k_run = 512;
constexpr std::size_t k_changed_run = 32;

std::uint32_t cell_hash(std::int64_t x, std::int64_t y, std::int32_t level) {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL;
    h ^= (static_cast<std::uint64_t>(y) + static_cast<std::uint64_t>(level) * 0x632BE59BD9B4E019ULL) *
         0xC2B2AE3D27D4EB4FULL;
    h ^= h >> 32;
    return static_cast<std::uint32_t>(h * 0xD6E8FEB86659FD93ULL >> 32);
}

std::int64_t cell_of(double position, double cell) { return static_cast<std::int64_t>(std::floor(position / cell)); }

bool do_meet(const BoundingCircle& a, const BoundingCircle& b) {
    const double reach = a.radius + b.radius;
    return (a.centre - b.centre).squaredNorm() < reach * reach;
}

GrainPair pair_of(GrainIndex a, GrainIndex b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

/// Calls visit(circle) for every circle that was entered in a cell.
template <typename Visit>
void NeighbourSearch::each_in(std::int64_t x, std::int64_t y, std::int32_t level, const Visit& visit) const {
    const std::uint32_t b = bucket_of(x, y, level);
    for (std::int32_t n = bucket_start_[b]; n < bucket_start_[b + 1]; ++n) {
        const Entry& entry = sorted_[static_cast<std::size_t>(n)];
        if (entry.level == level && entry.cell_x == x && entry.cell_y == y) visit(entry.circle);
    }
}

void NeighbourSearch::find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs) {
    pairs.clear();
    loose_.clear();
    is_loose_.assign(circles.size(), 0);
    if (circles.size() < 2) return;
    enter(circles);
    sort_into_buckets();
    // Each circle looks at its own level and at every coarser one, where it meets the larger circles.
    const auto levels = static_cast<std::int32_t>(level_used_.size());
    found_.resize((entries_.size() + k_run - 1) / k_run);
    parallel_.runs(entries_.size(), k_run, [&](std::size_t first, std::size_t last) {
        std::vector<GrainPair>& found = found_[first / k_run];
        found.clear();
        for (std::size_t k = first; k < last; ++k) {
            const Entry& self = entries_[k];
            for (std::int32_t level = self.level; level < levels; ++level) {
                if (level_used_[static_cast<std::size_t>(level)]) meet(self, level, circles, found);
            }
        }
    });
    gather(circles.size(), pairs);
}

void NeighbourSearch::renew_pairs(std::span<const BoundingCircle> circles, std::span<const GrainIndex> changed,
                                  std::vector<GrainPair>& pairs) {
    if (circles.size() < 2) return;
    is_changed_.assign(circles.size(), 0);
    for (const GrainIndex k : changed) {
        is_changed_[Grains::at(k)] = 1;
        if (is_loose_[Grains::at(k)]) continue;
        is_loose_[Grains::at(k)] = 1;
        loose_.push_back(k);
    }
    found_.resize((changed.size() + k_changed_run - 1) / k_changed_run);
    parallel_.runs(changed.size(), k_changed_run, [&](std::size_t first, std::size_t last) {
        found_[first / k_changed_run].clear();
        for (std::size_t n = first; n < last; ++n) meet_all(changed[n], circles, found_[first / k_changed_run]);
    });
    merged_.clear();
    for (const auto& found : found_) merged_.insert(merged_.end(), found.begin(), found.end());
    const auto fresh = static_cast<std::ptrdiff_t>(merged_.size());
    std::sort(merged_.begin(), merged_.end());
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(merged_), [&](const GrainPair& pair) {
        return !is_changed_[Grains::at(pair.first)] && !is_changed_[Grains::at(pair.second)];
    });
    pairs.resize(merged_.size());
    std::merge(merged_.begin(), merged_.begin() + fresh, merged_.begin() + fresh, merged_.end(), pairs.begin());
}

/// The pairs of a changed circle: with those that stand where they were entered, and with the loose ones.
void NeighbourSearch::meet_all(GrainIndex self, std::span<const BoundingCircle> circles,
                               std::vector<GrainPair>& pairs) const {
    const BoundingCircle& circle = circles[Grains::at(self)];
    for (const GrainIndex other : loose_) {
        const bool mine = other < self || (other > self && !is_changed_[Grains::at(other)]);
        if (mine && do_meet(circle, circles[Grains::at(other)])) pairs.push_back(pair_of(self, other));
    }
    const auto meet_entered = [&](GrainIndex other) {
        if (is_loose_[Grains::at(other)]) return;
        if (do_meet(circle, circles[Grains::at(other)])) pairs.push_back(pair_of(self, other));
    };
    // A circle so large that it covers more cells of a level than there are circles looks at these instead.
    const auto levels = static_cast<std::int32_t>(level_used_.size());
    const auto most_cells = static_cast<double>(entries_.size());
    std::int32_t first = 0;
    for (; first < levels; ++first) {
        const double across = 2.0 * circle.radius / cell_size(first) + 2.0;
        if (across * across <= most_cells) break;
    }
    if (first > 0) {
        for (const Entry& entry : entries_) {
            if (entry.level < first) meet_entered(entry.circle);
        }
    }
    for (std::int32_t level = first; level < levels; ++level) {
        if (!level_used_[static_cast<std::size_t>(level)]) continue;
        const double cell = cell_size(level);
        const double reach = circle.radius + 0.5 * cell;  // no circle of the level is larger
        const std::int64_t last_x = cell_of(circle.centre.x() + reach, cell);
        const std::int64_t last_y = cell_of(circle.centre.y() + reach, cell);
        for (std::int64_t x = cell_of(circle.centre.x() - reach, cell); x <= last_x; ++x) {
            for (std::int64_t y = cell_of(circle.centre.y() - reach, cell); y <= last_y; ++y) {
                each_in(x, y, level, meet_entered);
            }
        }
    }
}

// A counting sort by the lower grain; the few pairs of one grain are sorted by comparison.
void NeighbourSearch::gather(std::size_t circles, std::vector<GrainPair>& pairs) {
    fill_.assign(circles + 1, 0);
    for (const auto& found : found_) {
        for (const auto& [a, b] : found) ++fill_[static_cast<std::size_t>(a) + 1];
    }
    for (std::size_t a = 0; a < circles; ++a) fill_[a + 1] += fill_[a];
    pairs.resize(static_cast<std::size_t>(fill_.back()));
    for (const auto& found : found_) {
        for (const GrainPair& pair : found) {
            pairs[static_cast<std::size_t>(fill_[static_cast<std::size_t>(pair.first)]++)] = pair;
        }
    }
    // Where the pairs of a grain end is now where those of the next one begin.
    parallel_.runs(circles, k_run, [&](std::size_t first, std::size_t last) {
        auto begin = pairs.begin() + (first > 0 ? fill_[first - 1] : 0);
        for (std::size_t a = first; a < last; ++a) {
            const auto end = pairs.begin() + fill_[a];
            std::sort(begin, end);
            begin = end;
        }
    });
}

// Level l holds radii up to smallest x 2^(l + 1) in cells of twice that: a circle reaches the neighbouring cells of its
// level at most.
double NeighbourSearch::cell_size(std::int32_t level) const { return std::ldexp(smallest_, level + 2); }

std::uint32_t NeighbourSearch::bucket_of(std::int64_t x, std::int64_t y, std::int32_t level) const {
    return cell_hash(x, y, level) & (static_cast<std::uint32_t>(bucket_start_.size()) - 2);
}

void NeighbourSearch::enter(std::span<const BoundingCircle> circles) {
    smallest_ = std::numeric_limits<double>::infinity();
    for (const BoundingCircle& c : circles) smallest_ = std::min(smallest_, c.radius);
    entries_.clear();
    level_used_.clear();
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const auto& [centre, radius] = circles[k];
        const std::int32_t level = radius > smallest_ ? std::max(0, std::ilogb(radius / smallest_)) : 0;
        const double cell = cell_size(level);
        if (level_used_.size() <= static_cast<std::size_t>(level)) {
            level_used_.resize(static_cast<std::size_t>(level) + 1, 0);
        }
        level_used_[static_cast<std::size_t>(level)] = 1;
        entries_.push_back({cell_of(centre.x(), cell), cell_of(centre.y(), cell), level, static_cast<GrainIndex>(k)});
    }
}

// Counting sort into a power of two of hash buckets; a bucket keeps rising circle numbers.
void NeighbourSearch::sort_into_buckets() {
    const std::uint32_t buckets = std::bit_ceil(static_cast<std::uint32_t>(2 * entries_.size()));
    bucket_start_.assign(buckets + 1, 0);
    for (const Entry& e : entries_) ++bucket_start_[bucket_of(e.cell_x, e.cell_y, e.level) + 1];
    for (std::uint32_t b = 0; b < buckets; ++b) bucket_start_[b + 1] += bucket_start_[b];
    sorted_.resize(entries_.size());
    fill_.assign(bucket_start_.begin(), bucket_start_.end() - 1);
    for (const Entry& e : entries_) {
        sorted_[static_cast<std::size_t>(fill_[bucket_of(e.cell_x, e.cell_y, e.level)]++)] = e;
    }
}

void NeighbourSearch::meet(const Entry& self, std::int32_t level, std::span<const BoundingCircle> circles,
                           std::vector<GrainPair>& pairs) const {
    const BoundingCircle& circle = circles[static_cast<std::size_t>(self.circle)];
    const double cell = cell_size(level);
    const std::int64_t cx = cell_of(circle.centre.x(), cell);
    const std::int64_t cy = cell_of(circle.centre.y(), cell);
    // At its own level a circle looks at its own cell and at four of the eight around it: the others look at it.
    const bool own_level = level == self.level;
    constexpr std::int64_t k_own_cell = 4;
    for (std::int64_t place = own_level ? k_own_cell : 0; place < 9; ++place) {
        const std::int64_t x = cx - 1 + place % 3;
        const std::int64_t y = cy - 1 + place / 3;
        each_in(x, y, level, [&](GrainIndex other) {
            if (own_level && place == k_own_cell && other <= self.circle) return;
            if (do_meet(circle, circles[Grains::at(other)])) pairs.push_back(pair_of(self.circle, other));
        });
    }
}

}  // namespace polargrain
