#include "src/observe/free_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "src/core/error.h"
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

/// Strips side by side from the left wall on, as many to a mean outer diameter as wanted. Only those that a standing
/// grain can reach are kept, so that their number follows the grains, however far the walls are apart.
class Strips {
public:
    Strips(const Scene& scene, const Grains& grains, const Standing& standing, double a_diameter)
        : count_(std::max(1.0, std::round(a_diameter * standing.width / (2.0 * mean_outer_radius(scene))))),
          width_(standing.width / count_) {
        std::vector<Run> reaches;
        for (const GrainIndex k : standing.grains) {
            const double x = standing.corner.to_local(grains.position(k)).x();
            const double reach = outer_radius(scene.shape_of(k)) + width_;  // a strip more, against rounding
            reaches.push_back({first_from(x - reach), end_at(x + reach), 0});
        }
        std::ranges::sort(reaches, {}, &Run::first);
        for (const Run& reach : reaches) {
            if (runs_.empty() || reach.first > runs_.back().end) runs_.push_back(reach);
            runs_.back().end = std::max(runs_.back().end, reach.end);
        }
        std::size_t kept = 0;
        for (Run& run : runs_) {
            run.at = kept;
            kept += static_cast<std::size_t>(run.end - run.first);
        }
        heights_.assign(kept, 0.0);
    }

    double width() const { return width_; }  ///< of a strip [m]
    /// Of the strips that are kept, from left to right [m]; zero as long as a strip is empty, as all others are.
    const std::vector<double>& heights() const { return heights_; }

    /// The middles of the strips that are not empty, at their heights, from left to right.
    std::vector<Vec2> tops() const {
        std::vector<Vec2> tops;
        for (const Run& run : runs_) {
            for (std::int64_t strip = run.first; strip < run.end; ++strip) {
                const double height = heights_[run.at + static_cast<std::size_t>(strip - run.first)];
                if (height > 0.0) tops.emplace_back(middle(strip), height);
            }
        }
        return tops;
    }

    /// Raises the strip in which x lies, which a standing grain reaches, to a height.
    void raise_at(double x, double height) {
        const auto strip = static_cast<std::int64_t>(std::min(std::floor(x / width_), count_ - 1.0));
        double& kept = *place_of(strip);
        kept = std::max(kept, height);
    }

    /// Raises the strips whose middles lie in [from, to], within reach of one grain, to height_at(middle).
    template <typename HeightAt>
    void raise_between(double from, double to, HeightAt&& height_at) {
        const std::int64_t first = first_from(from), end = end_at(to);
        if (first >= end) return;
        double* kept = place_of(first);
        for (std::int64_t strip = first; strip < end; ++strip, ++kept)
            *kept = std::max(*kept, height_at(middle(strip)));
    }

private:
    /// Strips without a gap between them.
    struct Run {
        std::int64_t first, end;
        std::size_t at;  ///< where their heights begin
    };

    double middle(std::int64_t strip) const { return (static_cast<double>(strip) + 0.5) * width_; }
    std::int64_t first_from(double x) const {
        return static_cast<std::int64_t>(std::clamp(std::ceil(x / width_ - 0.5), 0.0, count_));
    }
    std::int64_t end_at(double x) const {
        return static_cast<std::int64_t>(std::clamp(std::floor(x / width_ - 0.5) + 1.0, 0.0, count_));
    }
    double* place_of(std::int64_t strip) {
        const Run& run = *std::prev(std::ranges::upper_bound(runs_, strip, {}, &Run::first));
        PG_ASSERT(strip >= run.first && strip < run.end, "strip {} is kept by none of {} runs", strip, runs_.size());
        return heights_.data() + run.at + static_cast<std::size_t>(strip - run.first);
    }

    double count_;
    double width_;
    std::vector<Run> runs_;
    std::vector<double> heights_;
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

/// The tops that a line is laid through.
std::vector<Vec2> tops_of_line(const Strips& columns, const Pose& corner, const std::optional<Region>& region) {
    std::vector<Vec2> tops = columns.tops();
    if (region) {
        std::erase_if(tops, [&](const Vec2& top) { return !region->holds(corner.to_world(top)); });
        return tops;
    }
    const auto skip = static_cast<std::ptrdiff_t>(tops.size() / 5);
    return {tops.begin() + skip, tops.end() - skip};
}

}  // namespace

std::optional<double> area_under_tops(const Scene& scene, const Grains& grains) {
    const std::optional<Standing> standing = standing_grains(scene, grains);
    if (!standing) return std::nullopt;
    Strips lines(scene, grains, *standing, k_lines_a_diameter);
    for (const GrainIndex k : standing->grains) {
        const Pose pose = grains.pose(k).relative_to(standing->corner);
        std::visit([&](const auto& shape) { raise_under(lines, shape, pose); }, scene.shape_of(k));
    }
    double under = 0.0;
    for (const double height : lines.heights()) under += lines.width() * height;
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
    Strips columns(scene, grains, *standing, 1.0);
    for (const GrainIndex k : standing->grains) {
        const Vec2 centre = standing->corner.to_local(grains.position(k));
        columns.raise_at(centre.x(), centre.y() + outer_radius(scene.shape_of(k)));
    }
    const std::vector<Vec2> chosen = tops_of_line(columns, standing->corner, region);
    if (chosen.size() < 3) return std::nan("");
    const auto n = static_cast<double>(chosen.size());
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const Vec2& top : chosen) {
        x += top.x() / n;
        y += top.y() / n;
    }
    for (const Vec2& top : chosen) {
        xx += (top.x() - x) * (top.x() - x);
        xy += (top.x() - x) * (top.y() - y);
    }
    return std::atan(xy / xx);
}

}  // namespace polargrain
