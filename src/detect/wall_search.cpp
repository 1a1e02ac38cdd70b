#include "src/detect/wall_search.h"

#include <algorithm>
#include <numeric>

namespace polargrain {

namespace {

/// The bits of two numbers in turn: numbers close in both are mostly close in what comes out.
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y) {
    std::uint64_t both = 0;
    for (unsigned bit = 0; bit < 32; ++bit) {
        both |= (static_cast<std::uint64_t>(x >> bit & 1U) << (2 * bit)) |
                (static_cast<std::uint64_t>(y >> bit & 1U) << (2 * bit + 1));
    }
    return both;
}

/// Pieces of one wall: where they begin, how many they are, and the middle of the box around them.
struct Row {
    std::size_t first = 0, count = 0;
    Vec2 middle = Vec2::Zero();
    std::uint32_t rank_x = 0, rank_y = 0;
};

std::vector<Row> rows_of(std::span<const PlacedPiece> pieces) {
    std::vector<Row> rows;
    for (std::size_t first = 0; first < pieces.size();) {
        std::size_t last = first;
        Vec2 low = pieces[first].piece.a;
        Vec2 high = low;
        for (; last < pieces.size() && pieces[last].wall == pieces[first].wall; ++last) {
            const auto& [a, b] = pieces[last].piece;
            low = low.cwiseMin(a).cwiseMin(b);
            high = high.cwiseMax(a).cwiseMax(b);
        }
        rows.push_back({first, last - first, 0.5 * (low + high)});
        first = last;
    }
    return rows;
}

}  // namespace

WallSearch::Box WallSearch::around(const WallPiece& piece) {
    return {std::min(piece.a.x(), piece.b.x()), std::min(piece.a.y(), piece.b.y()), std::max(piece.a.x(), piece.b.x()),
            std::max(piece.a.y(), piece.b.y())};
}

void WallSearch::place(std::span<const PlacedPiece> pieces) {
    if (number_.size() != pieces.size()) arrange(pieces);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        boxes_[k] = around(pieces[static_cast<std::size_t>(number_[k])].piece);
    }
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const auto [first_below, count_below] = levels_[level - 1];
        for (std::size_t k = 0; k < levels_[level].count; ++k) {
            const std::size_t last = std::min((k + 1) * k_branches, count_below);
            Box all = boxes_[first_below + k * k_branches];
            for (std::size_t n = k * k_branches + 1; n < last; ++n) {
                const Box& box = boxes_[first_below + n];
                all = {std::min(all.left, box.left), std::min(all.bottom, box.bottom), std::max(all.right, box.right),
                       std::max(all.top, box.top)};
            }
            boxes_[levels_[level].first + k] = all;
        }
    }
}

void WallSearch::find(const Vec2& centre, double reach, std::vector<std::int32_t>& near) const {
    near.clear();
    any_near(centre, reach, [&near](std::int32_t piece) {
        near.push_back(piece);
        return false;
    });
    if (!in_order_) std::sort(near.begin(), near.end());
}

void WallSearch::arrange(std::span<const PlacedPiece> pieces) {
    number_.resize(pieces.size());
    std::iota(number_.begin(), number_.end(), 0);
    levels_.clear();
    std::size_t first = 0;
    std::size_t count = pieces.size();
    levels_.push_back({first, count});
    while (count > k_enough) {
        first += count;
        count = (count + k_branches - 1) / k_branches;
        levels_.push_back({first, count});
    }
    boxes_.resize(first + count);
    if (levels_.size() > 1) sort_walls(pieces);
    in_order_ = std::is_sorted(number_.begin(), number_.end());
}

// By the ranks of their middles and not by these, so that one wall far away does not make the others one.
void WallSearch::sort_walls(std::span<const PlacedPiece> pieces) {
    std::vector<Row> rows = rows_of(pieces);
    const auto rank = [&rows](int axis, std::uint32_t Row::*of) {
        std::stable_sort(rows.begin(), rows.end(),
                         [axis](const Row& p, const Row& q) { return p.middle[axis] < q.middle[axis]; });
        for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*of = static_cast<std::uint32_t>(k);
    };
    rank(0, &Row::rank_x);
    rank(1, &Row::rank_y);
    std::sort(rows.begin(), rows.end(), [](const Row& p, const Row& q) {
        return interleaved(p.rank_x, p.rank_y) < interleaved(q.rank_x, q.rank_y);
    });
    std::size_t place = 0;
    for (const Row& row : rows) {
        for (std::size_t k = 0; k < row.count; ++k) number_[place++] = static_cast<std::int32_t>(row.first + k);
    }
}

}  // namespace polargrain
