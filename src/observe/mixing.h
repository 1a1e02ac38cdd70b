#pragma once

#include <optional>

#include "src/observe/kind.h"

namespace polargrain {

/// Lacey's mixing index of the marked grains among all that are in: 0 apart, about 1 mixed at random. [L54]
///
///   M = (S0^2 - S^2) / (S0^2 - SR^2),  S0^2 = p (1 - p),  SR^2 = p (1 - p) / n
/// S^2: variance of the share of marked grains over square cells `cell` [m] wide, each weighted by its number of
/// grains; p: share of marked grains; n: mean number of grains in a cell, weighted alike. Cells count from the lower
/// left corner of the grains' bounding box. NaN where there is one kind only, or where each cell holds a single grain.
double lacey_index(const Scene& scene, const Grains& grains, const GrainMask& mask, double cell,
                   const std::optional<Region>& region = {});

/// Share of the marked grains whose centres lie in the region. NaN where none is marked.
double share_in_region(const Grains& grains, const GrainMask& mask, const Region& region);

/// Share of marked grains among those whose centres lie in the region. NaN where the region is empty.
double purity(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region = {});

/// How high the marked grains lie among the others: the share of the other grains that are in whose centres lie lower
/// (against gravity), mean over the marked grains that are in. 0 at the bottom, 1/2 mixed, 1 on top. NaN where either
/// kind is missing.
double height_rank(const Scene& scene, const Grains& grains, const GrainMask& mask);

}  // namespace polargrain
