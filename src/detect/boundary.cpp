#include "src/detect/boundary.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

/// Is the piece, neither end of which lies within the radius of the origin, nearer than that somewhere between?
bool middle_within(const Vec2& p, const Vec2& q, double turn, double radius_squared) {
    const Vec2 along = q - p;
    return p.dot(along) < 0.0 && q.dot(along) > 0.0 && turn * turn < radius_squared * along.squaredNorm();
}

/// Does the sweep towards q meet the ray of the vertex before it gets to q? Round-off may have put an end that lies on
/// a ray into the sector on the other side of it; the sweep must not run round the whole outline then.
bool before_end(const Vec2& vertex, const Vec2& q, double turn) {
    return turn > 0.0 ? cross(vertex, q) > 0.0 : cross(vertex, q) < 0.0;
}

}  // namespace

bool piece_enters(const PolarPolygon& polygon, const Vec2& p, const Vec2& q, double tolerance) {
    const Vec2 along = q - p;
    const double turn = cross(p, q);  // twice the area swept as seen from the centre of mass
    const double reach = polygon.outer_radius() * polygon.outer_radius();
    const bool p_near = p.squaredNorm() < reach;
    const bool q_near = q.squaredNorm() < reach;
    if (!p_near && !q_near && !middle_within(p, q, turn, reach)) return false;

    const int first = polygon.sector_of(p);
    if (p_near && polygon.depth(p, first) > tolerance) return true;
    const int last = polygon.sector_of(q);
    if (q_near && polygon.depth(q, last) > tolerance) return true;
    if (turn == 0.0) return p.dot(q) < 0.0;  // along a ray: through the centre, or wholly on one side

    for (int sector = first; sector != last;) {
        const int ray = turn > 0.0 ? polygon.next(sector) : sector;
        const Vec2 vertex = polygon.vertex(ray);
        if (!before_end(vertex, q, turn)) break;
        // The piece meets the ray at turn / w of the vertex radius.
        const double w = cross(vertex, along);
        const double inward = 1.0 - turn / w;
        if (inward > 0.0 && inward * std::min(polygon.offset(ray), polygon.offset(polygon.previous(ray))) > tolerance) {
            return true;
        }
        sector = turn > 0.0 ? polygon.next(sector) : polygon.previous(sector);
    }
    return false;
}

int exit_edge(const PolarPolygon& polygon, const Vec2& inside, const Vec2& outside) {
    const Vec2 along = outside - inside;
    const double turn = cross(inside, outside);
    const int last = polygon.sector_of(outside);
    int sector = polygon.sector_of(inside);
    while (sector != last) {
        const int ray = turn > 0.0 ? polygon.next(sector) : sector;
        const Vec2 vertex = polygon.vertex(ray);
        if (!before_end(vertex, outside, turn)) break;
        if (!(turn / cross(vertex, along) < 1.0)) return sector;  // already outside where it meets the ray
        sector = turn > 0.0 ? polygon.next(sector) : polygon.previous(sector);
    }
    return sector;
}

}  // namespace polargrain
