#pragma once

#include <span>
#include <vector>

#include "src/model/contact.h"
#include "src/model/grains.h"

namespace polargrain {

/// Tells which items - contacts, or pairs - a grain takes part in, in rising order.
class ByGrain {
public:
    /// Items are anything with bodies i and j, of which j may be a wall.
    template <typename Item>
    void index(const std::vector<Item>& items, std::size_t grains) {
        first_.assign(grains + 1, 0);
        for (const Item& item : items) {
            ++first_[Grains::at(item.i) + 1];
            if (!is_wall(item.j)) ++first_[Grains::at(item.j) + 1];
        }
        for (std::size_t k = 0; k < grains; ++k) first_[k + 1] += first_[k];
        next_.assign(first_.begin(), first_.end() - 1);
        items_.resize(static_cast<std::size_t>(first_.back()));
        for (std::size_t n = 0; n < items.size(); ++n) {
            put(items[n].i, n);
            if (!is_wall(items[n].j)) put(items[n].j, n);
        }
    }

    std::span<const std::int32_t> of(GrainIndex grain) const {
        return {items_.data() + first_[Grains::at(grain)], items_.data() + first_[Grains::at(grain) + 1]};
    }

private:
    void put(GrainIndex grain, std::size_t item) {
        items_[static_cast<std::size_t>(next_[Grains::at(grain)]++)] = static_cast<std::int32_t>(item);
    }

    std::vector<std::int32_t> first_, next_, items_;
};

}  // namespace polargrain
