#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/model/scene.h"

namespace polargrain {

/// What kind of number an observable is; decides which units it takes.
enum class Dimension : std::uint8_t {
    number,  ///< a ratio
    count,
    percent,
    length,
    time,
    rate,  ///< one over time
    speed,
    speed_squared,
    energy,  ///< per metre of depth
    pressure,
    angle,
    area_rate,
    domino_speed,
};

/// The units that go with a dimension, the one in which values are kept first.
///
/// Some are made of the scene at time zero: d is the mean outer diameter of the grains, m their mean mass per metre of
/// depth, rho their mean density, g gravity.
std::vector<std::string> units_of(Dimension dimension);

/// How much of the first unit makes one of the given; none where the unit does not go with the dimension. The empty
/// unit is the first one. Infinite or NaN where the scene lacks what the unit is made of.
std::optional<double> unit_scale(Dimension dimension, const std::string& unit, const Scene& scene);

}  // namespace polargrain
