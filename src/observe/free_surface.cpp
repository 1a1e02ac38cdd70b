#include "src/observe/free_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "src/observe/bed.h"

namespace polargrain {

namespace {

constexpr double k_lines_a_diameter = 64.0;

/// The grains of a bed that stand between the walls and above their lowest point.
struct Standing {
    Pose corner;         ///< the lowest height at the left wall, x across gravity and y against it
    double width = 0.0;  ///< between the walls [m]
    std::vector<GrainIndex> grains;
};

std::optional<Standing> standing_grains(const Scene& scene, const Grains& grains) {
    const std::optional<double> floor = outlet_height(scene);
    if (!floor || grains.empty()) return std::nullopt;
    const Vec2 up = upwards(scene);
    const Vec2 across = right_normal(up);
    const auto [left, right] = wall_width(scene);
    Standing standing{{left * across + *floor * up, across.x(), across.y()}, right - left, {}};
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const Vec2 centre = standing.corner.to_local(grains.position(k));
        if (centre.y() >= 0.0 && centre.x() >= 0.0 && centre.x() < standing.width) standing.grains.push_back(k);
    }
    return standing;
}

/// Strips side by side from the left wall on, as many to a mean outer diameter as wanted.
struct Strips {
    double width = 0.0;           ///< of a strip [m]
    std::vector<double> heights;  ///< [m], zero as long as a strip is empty

    Strips(const Scene& scene, double across, double a_diameter) {
        const double n = std::max(1.0, std::round(a_diameter * across / (2.0 * mean_outer_radius(scene))));
        width = across / n;
        heights.assign(static_cast<std::size_t>(n), 0.0);
    }

    double middle(std::size_t strip) const { return (static_cast<double>(strip) + 0.5) * width; }
    void raise(std::size_t strip, double height) { heights[strip] = std::max(heights[strip], height); }

    /// Raises the strips whose middles lie in [from, to] to height_at(middle).
    template <typename HeightAt>
    void raise_between(double from, double to, HeightAt&& height_at) {
        const auto end = static_cast<double>(heights.size());
        const double first = std::clamp(std::ceil(from / width - 0.5), 0.0, end);
        const double last = std::clamp(std::floor(to / width - 0.5) + 1.0, 0.0, end);
        for (auto strip = static_cast<std::size_t>(first); strip < static_cast<std::size_t>(last); ++strip) {
            raise(strip, height_at(middle(strip)));
        }
    }
};

void raise_under(Strips& strips, const Disk& disk, const Pose& pose) {
    const double r = disk.radius();
    strips.raise_between(pose.centre.x() - r, pose.centre.x() + r, [&](double x) {
        const double off = x - pose.centre.x();
        return pose.centre.y() + std::sqrt(std::max(0.0, r * r - off * off));
    });
}

void raise_under(Strips& strips, const PolarPolygon& polygon, const Pose& pose) {
    const std::vector<Vec2> outline = polygon.vertices();
    for (std::size_t q = 0; q < outline.size(); ++q) {
        Vec2 a = pose.to_world(outline[q]);
        Vec2 b = pose.to_world(outline[(q + 1) % outline.size()]);
        if (a.x() > b.x()) std::swap(a, b);
        strips.raise_between(a.x(), b.x(), [&](double x) {
            return b.x() > a.x() ? a.y() + (b.y() - a.y()) * ((x - a.x()) / (b.x() - a.x())) : std::max(a.y(), b.y());
        });
    }
}

/// Columns that a line is laid through.
std::vector<std::size_t> columns_of_line(const Strips& columns, const Pose& corner,
                                         const std::optional<Region>& region) {
    std::vector<std::size_t> chosen;
    for (std::size_t c = 0; c < columns.heights.size(); ++c) {
        if (columns.heights[c] <= 0.0) continue;
        if (!region || region->holds(corner.to_world({columns.middle(c), columns.heights[c]}))) chosen.push_back(c);
    }
    if (region) return chosen;
    const auto skip = static_cast<std::ptrdiff_t>(chosen.size() / 5);
    return {chosen.begin() + skip, chosen.end() - skip};
}

}  // namespace

std::optional<double> area_under_tops(const Scene& scene, const Grains& grains) {
    const std::optional<Standing> standing = standing_grains(scene, grains);
    if (!standing) return std::nullopt;
    Strips lines(scene, standing->width, k_lines_a_diameter);
    for (const GrainIndex k : standing->grains) {
        const Pose pose = grains.pose(k).relative_to(standing->corner);
        std::visit([&](const auto& shape) { raise_under(lines, shape, pose); }, scene.shape_of(k));
    }
    double under = 0.0;
    for (const double height : lines.heights) under += lines.width * height;
    return under;
}

double area_fraction(const Scene& scene, const Grains& grains) {
    const std::optional<Standing> standing = standing_grains(scene, grains);
    if (!standing || standing->grains.empty()) return std::nan("");
    double filled = 0.0;
    for (const GrainIndex k : standing->grains) filled += area(scene.shape_of(k));
    return filled / *area_under_tops(scene, grains);
}

double surface_slope(const Scene& scene, const Grains& grains, const std::optional<Region>& region) {
    const std::optional<Standing> standing = standing_grains(scene, grains);
    if (!standing) return std::nan("");
    Strips columns(scene, standing->width, 1.0);
    for (const GrainIndex k : standing->grains) {
        const Vec2 centre = standing->corner.to_local(grains.position(k));
        const auto column = std::min(static_cast<std::size_t>(centre.x() / columns.width), columns.heights.size() - 1);
        columns.raise(column, centre.y() + outer_radius(scene.shape_of(k)));
    }
    const std::vector<std::size_t> chosen = columns_of_line(columns, standing->corner, region);
    if (chosen.size() < 3) return std::nan("");
    const auto n = static_cast<double>(chosen.size());
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const std::size_t c : chosen) {
        x += columns.middle(c) / n;
        y += columns.heights[c] / n;
    }
    for (const std::size_t c : chosen) {
        xx += (columns.middle(c) - x) * (columns.middle(c) - x);
        xy += (columns.middle(c) - x) * (columns.heights[c] - y);
    }
    return std::atan(xy / xx);
}

}  // namespace polargrain
