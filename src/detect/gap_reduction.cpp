#include "src/detect/gap_reduction.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

constexpr double k_similar = 0.7;

/// A point of a group, by its tangential station.
struct Station {
    double s;
    double gap;
    std::size_t index;
};

double turn(const Station& a, const Station& b, const Station& c) {
    return (b.s - a.s) * (c.gap - a.gap) - (b.gap - a.gap) * (c.s - a.s);
}

void keep_lower_hull(std::vector<Station>& group) {
    std::sort(group.begin(), group.end(), [](const Station& p, const Station& q) {
        return p.s < q.s || (p.s == q.s && (p.gap < q.gap || (p.gap == q.gap && p.index < q.index)));
    });
    std::size_t kept = 0;
    for (const Station& next : group) {
        if (kept > 0 && group[kept - 1].s == next.s) continue;  // the deeper of the two is there already
        while (kept >= 2 && turn(group[kept - 2], group[kept - 1], next) <= 0.0) --kept;
        group[kept++] = next;
    }
    group.resize(kept);
}

/// The deepest, its two neighbours on the hull, and the end farthest from it.
void keep_most_telling(std::vector<Station>& hull) {
    if (hull.size() <= static_cast<std::size_t>(GapRules::k_most_per_group)) return;
    const auto deepest =
        std::min_element(hull.begin(), hull.end(), [](const Station& p, const Station& q) { return p.gap < q.gap; });
    const auto d = static_cast<std::size_t>(deepest - hull.begin());
    const std::size_t last = hull.size() - 1;
    const std::size_t far = hull[d].s - hull.front().s > hull.back().s - hull[d].s ? 0 : last;
    std::vector<Station> kept;
    for (std::size_t k = 0; k <= last; ++k) {
        if (k == d || k + 1 == d || k == d + 1 || k == far) kept.push_back(hull[k]);
    }
    hull = std::move(kept);
}

}  // namespace

void reduce_gap_points(std::vector<GapPoint>& points, std::size_t first) {
    if (points.size() - first <= 2) return;
    thread_local std::vector<char> grouped, keep;
    thread_local std::vector<Station> group;
    const std::size_t n = points.size() - first;
    grouped.assign(n, 0);
    keep.assign(n, 0);
    for (;;) {
        std::size_t deepest = n;
        for (std::size_t k = 0; k < n; ++k) {
            if (!grouped[k] && (deepest == n || points[first + k].gap < points[first + deepest].gap)) deepest = k;
        }
        if (deepest == n) break;
        const Vec2 normal = points[first + deepest].normal;
        const Vec2 tangent = right_normal(normal);
        group.clear();
        for (std::size_t k = 0; k < n; ++k) {
            if (grouped[k] || points[first + k].normal.dot(normal) <= k_similar) continue;
            grouped[k] = 1;
            group.push_back({points[first + k].point.dot(tangent), points[first + k].gap, k});
        }
        keep_lower_hull(group);
        keep_most_telling(group);
        for (const Station& s : group) keep[s.index] = 1;
    }
    std::size_t kept = first;
    for (std::size_t k = 0; k < n; ++k) {
        if (keep[k] || points[first + k].gap < 0.0) points[kept++] = points[first + k];
    }
    points.resize(kept);
}

}  // namespace polargrain
