#pragma once

#include <optional>

#include "src/observe/kind.h"

namespace polargrain {

// Means over grains that the mask marks, and whose centre lies in the region if there is one. NaN where there is none.

/// Centre of mass [m].
Vec2 centre_of_mass(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region = {});

/// Of all grains [m]; zero for no grains.
Vec2 centre_of_mass(const Grains& grains);

/// Mean velocity of the grains, each counting once [m/s].
Vec2 mean_velocity(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region = {});

/// Granular temperature [m^2/s^2]: half the mean square of the velocity about its mean, per degree of freedom.
/// A velocity gradient within the region counts as temperature: keep the region small where there is one. [C90]
double granular_temperature(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region = {});

/// Kinetic energy, translational and rotational, per grain and metre of depth [J/m].
double kinetic_energy_per_grain(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region = {});

}  // namespace polargrain
