#include "src/detect/edge_gaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polargrain {

namespace {

double least_rise(const Approach& v, const Vec2& normal) {
    return std::min(v.to_previous.dot(normal), v.to_next.dot(normal));
}

/// Has p passed the end q of the edge, and does q face an edge of p's body instead? Then that is the contact, which the
/// other direction finds; the edge drawn out beyond its end would strike p too early, along the wrong normal.
bool end_faces_instead(const PolarPolygon& polygon, const Approach& v, int edge, const GapRules& rules) {
    const Vec2 along = -right_normal(polygon.normal(edge));  // from its first vertex to its second
    for (const int end : {edge, polygon.next(edge)}) {
        const Vec2 q = polygon.vertex(end) - v.p;
        const double passed = end == edge ? along.dot(q) : -along.dot(q);
        if (passed <= rules.resting || reentrant(polygon, end)) continue;
        const Vec2 ways[2] = {v.to_previous, v.to_next};
        for (int n = 0; n < 2; ++n) {
            const double length = std::sqrt(ways[n].squaredNorm());
            const double station = ways[n].dot(q);
            if (station <= rules.resting * length || station >= length * length) continue;
            const Vec2 outward = n == 0 ? Vec2(-right_normal(ways[n]) / length) : Vec2(right_normal(ways[n]) / length);
            const double gap = outward.dot(q);
            if (gap < 0.0 || gap > rules.margin) continue;
            const Approach back{polygon.vertex(end), polygon.vertex(polygon.previous(end)) - polygon.vertex(end),
                                polygon.vertex(polygon.next(end)) - polygon.vertex(end)};
            if (!neighbour_behind(back, outward, gap)) return true;
        }
    }
    return false;
}

}  // namespace

EdgeGaps edges_near(const PolarPolygon& polygon, const Approach& v, int edge, double gap, const GapRules& rules) {
    EdgeGaps edges;
    struct End {
        int vertex;
        int across;
    };
    const End ends[2] = {{edge, polygon.previous(edge)}, {polygon.next(edge), polygon.next(edge)}};
    const auto at_corner = [&](const End& end) {
        return !reentrant(polygon, end.vertex) &&
               (v.p - polygon.vertex(end.vertex)).squaredNorm() < 4.0 * rules.resting * rules.resting;
    };
    const auto faces_better = [&](int across) {
        return least_rise(v, polygon.normal(across)) > least_rise(v, polygon.normal(edge));
    };
    // Round-off puts a corner that stands exactly on a corner a hair inside; that is touching.
    const double touching = -k_touch_tolerance * polygon.outer_radius();
    if (gap < touching) {
        // Inside, close to a corner, the sector says nothing about the way out: the edge that faces the vertex does.
        for (const End& end : ends) {
            if (!at_corner(end) || !faces_better(end.across)) continue;
            const double other = gap_to_edge(polygon, end.across, v.p);
            if (other < touching) {
                edges.add(end.across, other);
                return edges;
            }
        }
        edges.add(edge, gap);
        return edges;
    }
    if (!neighbour_behind(v, polygon.normal(edge), gap)) {
        if (!end_faces_instead(polygon, v, edge, rules)) edges.add(edge, gap);
        for (const End& end : ends) {
            if (!reentrant(polygon, end.vertex)) continue;
            if ((v.p - polygon.vertex(end.vertex)).squaredNorm() >= 4.0 * rules.margin * rules.margin) continue;
            const double other = gap_to_edge(polygon, end.across, v.p);
            if (other >= touching && other <= rules.margin) edges.add(end.across, other);
        }
        return edges;
    }
    for (const End& end : ends) {
        if (!at_corner(end) || !faces_better(end.across)) continue;
        const double other = gap_to_edge(polygon, end.across, v.p);
        if (other < touching || other >= rules.margin) continue;
        edges.add(end.across, other);
        return edges;
    }
    return edges;
}

void set_range(GapPoint& point, const Vec2& a, bool a_bounds, const Vec2& b, bool b_bounds, double slack) {
    const Vec2 t = right_normal(point.normal);
    const double at_a = t.dot(a - point.point);
    const double at_b = t.dot(b - point.point);
    // Travel of the point along its edge; where the point is j's, i travels the other way.
    double low = std::min(at_a, at_b);
    double high = std::max(at_a, at_b);
    bool low_bounds = at_a < at_b ? a_bounds : b_bounds;
    bool high_bounds = at_a < at_b ? b_bounds : a_bounds;
    if (!point.on_i) {
        std::swap(low, high);
        std::swap(low_bounds, high_bounds);
        low = -low;
        high = -high;
    }
    point.low = low_bounds && low <= 0.0 ? low - slack : -k_unbounded;
    point.high = high_bounds && high >= 0.0 ? high + slack : k_unbounded;
}

}  // namespace polargrain
