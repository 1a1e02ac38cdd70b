#pragma once

#include <span>
#include <vector>

#include "src/detect/neighbours.h"
#include "src/model/dem_settings.h"

namespace polargrain {

// Ways to find all pairs (a < b) of circles whose distance of centres is less than the sum of their radii, in ascending
// order. All give the same pairs; they differ in cost.

/// Every circle against every other: O(N^2), and nothing beside it to go wrong.
void find_pairs_directly(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs);

/// No binary search [ML04, sec. 3]: cells as large as the largest circle, singly linked lists
/// over rows and columns, O(N) time for circles of similar size. `pairs` is cleared first.
class NbsSearch {
public:
    void find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs);

private:
    /// Sorts circles into cells and rows; returns the number of columns.
    std::size_t enter_rows(std::span<const BoundingCircle> circles);
    void enter_columns(std::size_t row, int layer);
    void leave_columns(std::size_t row, int layer);
    void meet(std::span<const BoundingCircle> circles, std::int32_t self, std::int32_t other,
              std::vector<GrainPair>& pairs) const;

    std::vector<std::int32_t> column_, row_;                        // of each circle
    std::vector<std::int32_t> row_head_, next_in_row_;              // the circles of a row
    std::vector<std::int32_t> column_head_[2], next_in_column_[2];  // of the row at hand and the one below
    std::vector<char> row_done_;
};

/// Boxes entered in every cell that they cover [ML04, sec. 3]; a pair is reported only by the cell that holds the lower
/// left corner of what both boxes have in common, so never twice. Cells of k_cell_in_diameters mean diameters: O(N)
/// also for sizes far apart. `pairs` is cleared first.
class CgridSearch {
public:
    static constexpr double k_cell_in_diameters = 2.0;
    void find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs);

private:
    struct Entry {
        std::int64_t x, y;
        GrainIndex circle;
    };
    /// Brings entries that share a bucket together; returns the number of buckets.
    std::uint32_t sort_by_bucket();
    std::uint32_t bucket_of(std::int64_t x, std::int64_t y) const;

    std::vector<Entry> entries_, sorted_;
    std::vector<std::int32_t> start_, fill_;
};

/// The search that a setting names; for the Verlet list the hierarchy of grids.
class PairFinder {
public:
    explicit PairFinder(PairSearch search) : search_(search) {}
    void find_pairs(std::span<const BoundingCircle> circles, std::vector<GrainPair>& pairs);

private:
    PairSearch search_;
    NeighbourSearch hierarchy_;
    NbsSearch nbs_;
    CgridSearch cgrid_;
};

}  // namespace polargrain
