#include "src/observe/structure.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

/// Second moments of area of a polygon about its own origin [m^4]: integrals of x^2, xy and y^2.
SymmetricTensor second_moments(const PolarPolygon& polygon) {
    SymmetricTensor sum;
    for (int q = 0; q < polygon.size(); ++q) {
        const Vec2 a = polygon.vertex(q);
        const Vec2 b = polygon.vertex(polygon.next(q));
        const double twice_area = cross(a, b);
        sum.xx += twice_area / 12.0 * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
        sum.yy += twice_area / 12.0 * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y());
        sum.xy += twice_area / 24.0 * (2.0 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2.0 * b.x() * b.y());
    }
    return sum;
}

constexpr double k_elongated = 1.05;  // least ratio of radii of gyration

}  // namespace

double SymmetricTensor::deviator() const { return std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy); }

double SymmetricTensor::direction() const { return 0.5 * std::atan2(2.0 * xy, xx - yy); }

double coordination_number(const Grains& grains, std::span<const Contact> contacts,
                           const std::optional<Region>& region) {
    double within = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) within += in_region(region, grains.position(k)) ? 1.0 : 0.0;
    std::vector<std::pair<BodyIndex, BodyIndex>> pairs;
    pairs.reserve(contacts.size());
    for (const Contact& c : contacts) pairs.emplace_back(c.a, c.b);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    double partners = 0.0;
    for (const auto& [a, b] : pairs) {
        if (!is_wall(a) && in_region(region, grains.position(a))) partners += 1.0;
        if (in_region(region, grains.position(b))) partners += 1.0;
    }
    return within > 0.0 ? partners / within : std::nan("");
}

std::optional<SymmetricTensor> fabric_tensor(std::span<const Contact> contacts, const std::optional<Region>& region) {
    SymmetricTensor sum;
    double n = 0.0;
    for (const Contact& c : contacts) {
        if (is_wall(c.a) || !in_region(region, c.point)) continue;
        sum.xx += c.normal.x() * c.normal.x();
        sum.xy += c.normal.x() * c.normal.y();
        sum.yy += c.normal.y() * c.normal.y();
        n += 1.0;
    }
    if (n == 0.0) return std::nullopt;
    return SymmetricTensor{sum.xx / n, sum.xy / n, sum.yy / n};
}

std::optional<double> long_axis(const Shape& shape) {
    const auto* polygon = std::get_if<PolarPolygon>(&shape);
    if (polygon == nullptr) return std::nullopt;
    const SymmetricTensor moments = second_moments(*polygon);
    const double minor = moments.trace() - moments.major();
    if (moments.major() < k_elongated * k_elongated * minor) return std::nullopt;
    return moments.direction();
}

std::optional<Orientation> orientation_order(const Scene& scene, const Grains& grains, const GrainMask& mask,
                                             const std::optional<Region>& region) {
    std::vector<std::optional<double>> axes;
    axes.reserve(scene.shapes.size());
    for (const auto& shape : scene.shapes) axes.push_back(long_axis(*shape));
    SymmetricTensor sum;
    int n = 0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const auto& axis = axes[Grains::at(grains.shape[Grains::at(k)])];
        if (!axis || mask[Grains::at(k)] == 0 || !in_region(region, grains.position(k))) continue;
        const auto [sine, cosine] = sine_cosine(grains.angle[Grains::at(k)] + *axis);
        sum.xx += cosine * cosine;
        sum.xy += cosine * sine;
        sum.yy += sine * sine;
        ++n;
    }
    if (n == 0) return std::nullopt;
    // <u u> of unit vectors u has the deviator S and the preferred direction as its major axis.
    return Orientation{sum.deviator() / n, sum.direction(), n};
}

}  // namespace polargrain
