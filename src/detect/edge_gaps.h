#pragma once

#include <cmath>
#include <limits>

#include "src/detect/gap_points.h"

namespace polargrain {

// The rules of gap_points.h, for a point over an edge: of a grain that faces another, or a wall.

/// Travel without an end.
inline constexpr double k_unbounded = std::numeric_limits<double>::infinity();

/// A vertex of one body with its neighbours, in the frame of the polygon it comes near.
struct Approach {
    Vec2 p;
    Vec2 to_previous, to_next;  ///< from p; zero where there is no neighbour
};

/// Does the outline turn inwards there?
inline bool reentrant(const PolarPolygon& polygon, int vertex) {
    return cross(polygon.normal(polygon.previous(vertex)), polygon.normal(vertex)) < 0.0;
}

/// Distance of a point from the line of an edge [m], positive outside; in the frame of the polygon.
inline double gap_to_edge(const PolarPolygon& polygon, int edge, const Vec2& p) { return -polygon.depth(p, edge); }

/// Is a point over the edge that begins at `start` and goes along `along`, or beyond one of its ends by no more than
/// `slack` [m]?
inline bool is_over_edge(const Vec2& start, const Vec2& along, const Vec2& p, double slack) {
    const double length = std::sqrt(along.squaredNorm());
    const double station = along.dot(p - start);
    return station >= -slack * length && station <= (length + slack) * length;
}

/// Feature rule: does a neighbour of p lie behind the line of the edge?
inline bool neighbour_behind(const Approach& v, const Vec2& normal, double gap) {
    for (const Vec2& f : {v.to_previous, v.to_next}) {
        const double rise = f.dot(normal);
        if (gap + rise < 0.0 && rise < 0.0 && rise * rise > GapRules::k_behind * GapRules::k_behind * f.squaredNorm()) {
            return true;
        }
    }
    return false;
}

/// What a vertex near a polygon contributes: up to three edges and gaps.
struct EdgeGap {
    int edge;
    double gap;
};

struct EdgeGaps {
    EdgeGap found[3];
    int count = 0;
    void add(int edge, double gap) {
        if (count < 3) found[count++] = {edge, gap};
    }
};

/// The edge that bounds the free space of a vertex outside, by the feature and reflex rules; none where the true
/// contact is elsewhere. `edge` is the edge of the sector that holds the vertex, `gap` the distance from it, not beyond
/// the margin.
EdgeGaps edges_near(const PolarPolygon& polygon, const Approach& v, int edge, double gap, const GapRules& rules);

/// Edge-end rule: travel along t for which the point stays over the edge from a to b. An end that is re-entrant, or
/// has been passed already, does not bound.
void set_range(GapPoint& point, const Vec2& a, bool a_bounds, const Vec2& b, bool b_bounds, double slack);

}  // namespace polargrain
