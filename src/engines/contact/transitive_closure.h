#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "src/model/grains.h"

namespace polargrain {

/// "first must move before second; if first stays, second must stay." [HN94, sec. 3.7.2, step 2 of Fig. 8]
using MoveOrder = std::pair<GrainIndex, GrainIndex>;

/// Transitive closure of a relation by Warshall's algorithm on rows of bits: the plain statement of the method.
/// [HN94, Fig. 8, step 4]. Cost: n^3 / 64 operations, n^2 / 8 bytes.
class WarshallClosure {
public:
    WarshallClosure(GrainIndex grains, const std::vector<MoveOrder>& order);

    bool related(GrainIndex a, GrainIndex b) const;
    /// How many grains depend on a, a itself not counted.
    int dependants(GrainIndex a) const;

private:
    std::vector<std::uint64_t>::const_iterator row(GrainIndex a) const;

    std::size_t words_;
    std::vector<std::uint64_t> bits_;
};

/// The same counts by breadth-first search, on demand: in a bed nearly all grains are never asked for.
class ReachCount {
public:
    void build(GrainIndex grains, const std::vector<MoveOrder>& order);

    /// How many grains depend on a, a itself not counted. Cost: O(reach) the first time, O(1) afterwards.
    int dependants(GrainIndex a);

    /// Calls visit(b) for each grain that must stay at once if a stays.
    template <typename Visit>
    void for_each_direct(GrainIndex a, Visit visit) const {
        for (auto n = first_[Grains::at(a)]; n < first_[Grains::at(a) + 1]; ++n)
            visit(next_[static_cast<std::size_t>(n)]);
    }

private:
    std::vector<std::int32_t> first_, fill_;
    std::vector<GrainIndex> next_;
    std::vector<std::int32_t> count_;  // -1: not asked for yet
    std::vector<std::int32_t> seen_;   // stamp of the last search that came by
    std::vector<GrainIndex> queue_;
    std::int32_t stamp_ = 0;
};

}  // namespace polargrain
