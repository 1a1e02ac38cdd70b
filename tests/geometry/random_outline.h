#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/core/elementary.h"
#include "src/core/random.h"
#include "src/core/vec2.h"

namespace polargrain::testing {

/// How the vertices of a random star-shaped outline lie.
struct OutlineStyle {
    int vertices = 12;
    double least_radius = 0.3;  ///< the largest is 1
    double unevenness = 1.0;    ///< 1: angles uniform; large: most of them crowd together
};

/// Counter-clockwise vertices, star-shaped about the origin (not their centroid), distinct in direction.
inline std::vector<Vec2> random_star_shaped(RandomStream& random, const OutlineStyle& style) {
    for (;;) {
        std::vector<double> turns;
        for (int k = 0; k < style.vertices; ++k) turns.push_back(std::pow(random.uniform(), style.unevenness));
        const double start = random.uniform();
        std::sort(turns.begin(), turns.end());
        std::vector<Vec2> points;
        for (const double turn : turns) {
            const auto [s, c] = sine_cosine(2.0 * k_pi * (turn + start));
            points.emplace_back(random.uniform(style.least_radius, 1.0) * Vec2(c, s));
        }
        bool goes_round = true;
        for (std::size_t q = 0; q < points.size(); ++q) {
            const Vec2& next = points[(q + 1) % points.size()];
            goes_round = goes_round && cross(points[q], next) > 0.0;
        }
        if (goes_round) return points;
    }
}

/// How often the outline winds round the point (D. Sunday's count of upward and downward crossings).
inline int winding_number(const std::vector<Vec2>& outline, const Vec2& p) {
    int winds = 0;
    for (std::size_t q = 0; q < outline.size(); ++q) {
        const Vec2& a = outline[q];
        const Vec2& b = outline[(q + 1) % outline.size()];
        const double side = cross(b - a, p - a);
        if (a.y() <= p.y() && b.y() > p.y() && side > 0.0) ++winds;
        if (a.y() > p.y() && b.y() <= p.y() && side < 0.0) --winds;
    }
    return winds;
}

/// Distance of a point from a segment.
inline double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
}

}  // namespace polargrain::testing
