#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "src/detect/wall_pieces.h"

namespace polargrain {

/// Finds the wall pieces that a grain can meet.
///
/// A tree of boxes around the pieces, four in the next larger one. A question costs the logarithm of the number of
/// pieces and what is found, however long, short or far away pieces are. What stands together in the tree is near one
/// another and stays so where walls move: pieces of a wall follow one another along its chain, and walls are sorted by
/// place. Moved pieces are entered anew, in linear time.
class WallSearch {
public:
    /// Enters pieces where they are now; those of a wall stand in a row.
    void place(std::span<const PlacedPiece> pieces);

    /// The numbers, ascending, of all pieces within `reach` [m] of a point, up to round-off, and of some that are a
    /// little farther away. `near` is cleared first.
    void find(const Vec2& centre, double reach, std::vector<std::int32_t>& near) const;

    /// Calls visit(number) for the same pieces, in any order, until one answers true. Has one?
    template <typename Visit>
    bool any_near(const Vec2& centre, double reach, const Visit& visit) const;

private:
    struct Box {
        double left, bottom, right, top;
    };
    /// Boxes of one size: of pieces on level 0, of up to k_branches boxes of the level before on each other one.
    struct Level {
        std::size_t first, count;
    };
    static constexpr std::size_t k_branches = 4;
    static constexpr std::size_t k_enough = 8;  ///< boxes on the last level, which are all looked at

    static Box around(const Vec2& centre, double reach);
    static Box around(const WallPiece& piece);
    static bool meet(const Box& p, const Box& q) {
        return static_cast<int>(p.left <= q.right) & static_cast<int>(q.left <= p.right) &
               static_cast<int>(p.bottom <= q.top) & static_cast<int>(q.bottom <= p.top);
    }
    void arrange(std::span<const PlacedPiece> pieces);
    void sort_walls(std::span<const PlacedPiece> pieces);

    std::vector<std::int32_t> number_;  ///< of the piece at each place of level 0
    bool in_order_ = true;              ///< the numbers rise
    std::vector<Level> levels_;
    std::vector<Box> boxes_;
};

inline WallSearch::Box WallSearch::around(const Vec2& centre, double reach) {
    // Far more than the round-off of any test that looks at the found pieces more closely.
    constexpr double k_round_off = 1e-9;
    const double r = reach + k_round_off * (reach + std::abs(centre.x()) + std::abs(centre.y()));
    return {centre.x() - r, centre.y() - r, centre.x() + r, centre.y() + r};
}

template <typename Visit>
bool WallSearch::any_near(const Vec2& centre, double reach, const Visit& visit) const {
    if (boxes_.empty()) return false;
    const Box there = around(centre, reach);
    const std::size_t last = levels_.size() - 1;
    std::size_t level = last;
    std::size_t k = 0;
    while (k < levels_[level].count) {  // past the last box of any level nothing is left on the others
        if (meet(boxes_[levels_[level].first + k], there)) {
            if (level > 0) {
                --level;
                k *= k_branches;
                continue;
            }
            if (visit(number_[k])) return true;
        }
        ++k;
        for (; level < last && k % k_branches == 0; ++level) k /= k_branches;
    }
    return false;
}

}  // namespace polargrain
