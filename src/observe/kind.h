#pragma once

#include <vector>

#include "src/model/observable_spec.h"
#include "src/model/scene.h"

namespace polargrain {

/// One entry per grain: true for those that an observable is asked about.
using GrainMask = std::vector<char>;

/// Name under which a scenario declared a shape: that of each grain's own draw or size without its number and factor
/// ("grain#12*1.05" is of "grain").
std::string declared_name(const Shape& shape);

/// The grains of the given shape, of the given material and that started in the given region, as far as these are
/// given; all grains otherwise. Positions are those of scene.grains.
GrainMask kind_of_grains(const Scene& scene, const ObservableSpec& spec);

/// True where there is no region, or p lies in it.
inline bool in_region(const std::optional<Region>& region, const Vec2& p) { return !region || region->holds(p); }

}  // namespace polargrain
