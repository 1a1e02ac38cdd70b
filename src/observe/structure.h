#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/model/contact.h"
#include "src/observe/kind.h"

namespace polargrain {

/// A symmetric tensor of the plane.
struct SymmetricTensor {
    double xx = 0.0, xy = 0.0, yy = 0.0;

    double trace() const { return xx + yy; }
    /// Difference of the principal values, >= 0.
    double deviator() const;
    /// Larger principal value.
    double major() const { return 0.5 * (trace() + deviator()); }
    /// Direction of the larger principal value [rad], in (-pi/2, pi/2].
    double direction() const;
};

/// Grains and walls that a grain touches, mean over the grains whose centres lie in the region; a partner touched at
/// several places counts once. NaN without grains.
double coordination_number(const Grains& grains, std::span<const Contact> contacts,
                           const std::optional<Region>& region = {});

/// Fabric tensor <n n> of the contacts between grains whose points lie in the region; trace 1. [S82] Its deviator times
/// two is the anisotropy a of a distribution of contact directions (1 + a cos 2(theta - theta_0)) / 2 pi. None without
/// contacts.
std::optional<SymmetricTensor> fabric_tensor(std::span<const Contact> contacts,
                                             const std::optional<Region>& region = {});

/// Axis along which a shape is long, in its own frame [rad], in (-pi/2, pi/2]: the principal axis of its area. None
/// where the radii of gyration along and across differ by less than 5 %, as for disks and regular polygons.
std::optional<double> long_axis(const Shape& shape);

/// Order of the long axes.
struct Orientation {
    double order = 0.0;      ///< S = |<exp 2 i phi>|: 1 all parallel, 0 no direction preferred
    double direction = 0.0;  ///< the preferred one [rad], in (-pi/2, pi/2]
    int grains = 0;          ///< that have a long axis
};

/// Nematic order of the plane of marked grains whose centres lie in the region. [GP93, ch. 2] None where no grain has
/// a long axis.
std::optional<Orientation> orientation_order(const Scene& scene, const Grains& grains, const GrainMask& mask,
                                             const std::optional<Region>& region = {});

}  // namespace polargrain
