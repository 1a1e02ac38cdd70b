#pragma once

#include <span>
#include <utility>
#include <vector>

#include "src/core/parallel.h"
#include "src/core/vec2.h"
#include "src/model/grains.h"

namespace polargrain {

/// A circle about a grain; equal index order in all arrays.
struct BoundingCircle {
    Vec2 centre;
    double radius;
};

using GrainPair = std::pair<GrainIndex, GrainIndex>;

/// All pairs (a < b) of circles whose distance of centres is less than the sum of their radii [HN94, eq. 7], in
/// ascending order. `pairs` is cleared first and keeps its memory.
///
/// A hierarchy of hashed grids, each level for circles of one octave of size: time and memory are linear in the number
/// of circles however much their sizes differ, and wherever in the plane they are.
class NeighbourSearch {
public:
    /// threads share the search; their number changes nothing of the result.
    explicit NeighbourSearch(int threads = 1) : parallel_(threads) {}

    void find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs);

    /// Brings the pairs of the last find_pairs, or of this, up to date where only the circles that `changed` names, in
    /// rising order, differ: the same pairs as find_pairs would find. Cheaper while few have changed since find_pairs;
    /// see loose().
    void renew_pairs(std::span<const BoundingCircle> circles, std::span<const GrainIndex> changed,
                     std::vector<GrainPair>& pairs);

    /// How many circles have changed since find_pairs. Each that changes is compared with each of them.
    std::size_t loose() const { return loose_.size(); }

private:
    struct Entry {
        std::int64_t cell_x, cell_y;
        std::int32_t level;
        GrainIndex circle;
    };

    void enter(std::span<const BoundingCircle> circles);
    void sort_into_buckets();
    void gather(std::size_t circles, std::vector<GrainPair>& pairs);
    void meet(const Entry& self, std::int32_t level, std::span<const BoundingCircle> circles,
              std::vector<GrainPair>& pairs) const;
    template <typename Visit>
    void each_in(std::int64_t x, std::int64_t y, std::int32_t level, const Visit& visit) const;
    void meet_all(GrainIndex self, std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs) const;
    double cell_size(std::int32_t level) const;
    std::uint32_t bucket_of(std::int64_t x, std::int64_t y, std::int32_t level) const;

    double smallest_ = 0.0;         // radius [m]
    std::vector<char> level_used_;  // is there a circle of this level?
    std::vector<std::int32_t> bucket_start_, fill_;
    std::vector<Entry> entries_, sorted_;
    Parallel parallel_;
    std::vector<std::vector<GrainPair>> found_;  // by runs of entries
    std::vector<char> is_loose_;                 // no longer where it was entered
    std::vector<char> is_changed_;
    std::vector<GrainIndex> loose_;
    std::vector<GrainPair> merged_;
};

}  // namespace polargrain
