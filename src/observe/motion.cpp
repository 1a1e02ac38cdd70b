#include "src/observe/motion.h"

#include <cmath>
#include <limits>

namespace polargrain {

namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

/// Calls `each` with every marked grain in the region.
template <typename Each>
void for_chosen(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region, Each each) {
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        if (mask[Grains::at(k)] != 0 && in_region(region, grains.position(k))) each(k);
    }
}

}  // namespace

Vec2 centre_of_mass(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region) {
    Vec2 moment = Vec2::Zero();
    double mass = 0.0;
    for_chosen(grains, mask, region, [&](GrainIndex k) {
        moment += grains.mass[Grains::at(k)] * grains.position(k);
        mass += grains.mass[Grains::at(k)];
    });
    return mass > 0.0 ? Vec2(moment / mass) : Vec2(k_nan, k_nan);
}

Vec2 centre_of_mass(const Grains& grains) {
    return grains.empty() ? Vec2(Vec2::Zero()) : centre_of_mass(grains, GrainMask(grains.x.size(), 1));
}

Vec2 mean_velocity(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region) {
    Vec2 sum = Vec2::Zero();
    double n = 0.0;
    for_chosen(grains, mask, region, [&](GrainIndex k) {
        sum += grains.velocity(k);
        n += 1.0;
    });
    return n > 0.0 ? Vec2(sum / n) : Vec2(k_nan, k_nan);
}

double granular_temperature(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region) {
    const Vec2 mean = mean_velocity(grains, mask, region);
    double squares = 0.0;
    double n = 0.0;
    for_chosen(grains, mask, region, [&](GrainIndex k) {
        squares += (grains.velocity(k) - mean).squaredNorm();
        n += 1.0;
    });
    return n > 0.0 ? 0.5 * squares / n : k_nan;
}

double kinetic_energy_per_grain(const Grains& grains, const GrainMask& mask, const std::optional<Region>& region) {
    double sum = 0.0;
    double n = 0.0;
    for_chosen(grains, mask, region, [&](GrainIndex k) {
        const std::size_t i = Grains::at(k);
        sum += 0.5 * (grains.mass[i] * grains.velocity(k).squaredNorm() +
                      grains.inertia[i] * grains.spin[i] * grains.spin[i]);
        n += 1.0;
    });
    return n > 0.0 ? sum / n : k_nan;
}

}  // namespace polargrain
