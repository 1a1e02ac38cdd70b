#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/model/contact.h"

namespace polargrain {

/// Which grain of the scene stands at each place of the engine's arrays. The scene's own numbers to begin with; where
/// those of touching grains have come to lie far apart, grains that are near in space are put near in memory.
using Numbering = std::vector<GrainIndex>;

/// The scene's own numbers.
Numbering own_numbers(GrainIndex grains);

/// By rows across the shorter side of the ground that the grains cover, each as deep as `row` [m].
Numbering numbers_by_rows(const Grains& grains, double row);

/// At which place each grain of the scene stands.
Numbering places_of(const Numbering& numbers);

/// Puts the coordinates of grains, three of each, from the places of one numbering to those of another. `values`: any
/// number of such arrays behind one another, after values that belong to no grain.
void move_coordinates(const Numbering& from, const Numbering& to, std::vector<double>& values);

/// Sorts pairs of bodies, in time that grows linearly with their number.
class PairSorter {
public:
    using Pair = std::pair<BodyIndex, BodyIndex>;

    /// Indices of pairs in ascending order of these; equal ones keep their order. Walls have numbers from -walls on,
    /// grains up to grains - 1. Valid until the next call.
    const std::vector<std::uint32_t>& sort(std::span<const Pair> pairs, std::size_t walls, std::size_t grains);

private:
    /// By one body of each pair, keeping the order of equals.
    template <typename BodyOf>
    void sort_by(BodyOf body_of, std::size_t walls);

    std::vector<std::uint32_t> order_, sorted_, start_;
};

}  // namespace polargrain
