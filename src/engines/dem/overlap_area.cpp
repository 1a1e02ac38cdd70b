#include "src/engines/dem/overlap_area.h"

#include <algorithm>
#include <cmath>

#include "src/detect/facing.h"

namespace polargrain {

namespace {

/// Angle [rad] by which one of the two is turned: boxes laid exactly on one another, with sides in one line, have no
/// crossing points. Forces stay the exact gradient of an energy, that of the turned outline.
constexpr double k_nudge = 1e-10;

/// Depth over width below which a region is the nudge's: the half of two faces just met that it turned into one
/// another.
constexpr double k_of_the_nudge = 2.0 * k_nudge;

/// Edges with an end whose station along the unit direction (of the grain's frame) exceeds the limit, in the order of
/// the outline. `place` takes the grain's frame to that of the result.
template <typename Place>
void gather_edges(const PolarPolygon& grain, const Vec2& direction, double limit, Place place,
                  std::vector<OutlineEdge>& edges) {
    edges.clear();
    int next_start = -1;  // start of the edge that is still to be entered, so that none is entered twice
    int first = -1;
    const auto enter = [&](int k) {
        if (k == first) return;
        if (first < 0) first = k;
        const Vec2 from = !edges.empty() && next_start == k ? edges.back().to : place(grain.vertex(k));
        edges.push_back({from, place(grain.vertex(grain.next(k)))});
        next_start = grain.next(k);
    };
    int entered = -1;
    any_vertex_beyond(grain, direction, limit, [&](int k) {
        const int before = grain.previous(k);
        if (entered != before) enter(before);
        enter(k);
        entered = k;
        return false;
    });
}

}  // namespace

std::span<const OverlapRegion> OverlapArea::find(const PolarPolygon& a, const PolarPolygon& b, const Pose& pose) {
    regions_.clear();
    const double distance = std::sqrt(pose.centre.squaredNorm());
    if (!(distance > 0.0)) return regions_;
    const Vec2 towards = pose.centre / distance;
    const Vec2 back = pose.turned_back(-towards);
    const double reach_b = reach_along(b, back);
    if (distance - reach_b >= a.outer_radius()) return regions_;
    const double reach_a = reach_along(a, towards);
    if (reach_a + reach_b <= distance) return regions_;
    // What both have in common lies between the two lines across the way that bound them.
    gather_edges(
        a, towards, distance - reach_b, [](const Vec2& v) { return v; }, a_);
    const Pose nudged{pose.centre, pose.cosine - k_nudge * pose.sine, pose.sine + k_nudge * pose.cosine};
    gather_edges(
        b, back, distance - reach_a, [&nudged](const Vec2& v) { return nudged.to_world(v); }, b_);
    find_regions();
    return regions_;
}

std::span<const OverlapRegion> OverlapArea::find(std::span<const Vec2, 4> a, const PolarPolygon& b) {
    regions_.clear();
    const Vec2 inward = unit(left_normal(a[1] - a[0]));
    gather_edges(
        b, inward, inward.dot(a[0]), [](const Vec2& v) { return v; }, b_);
    if (b_.empty()) return regions_;
    a_.clear();
    const auto nudged = [&a](std::size_t k) { return Vec2(a[k] + k_nudge * left_normal(a[k])); };
    for (std::size_t k = 0; k < a.size(); ++k) a_.push_back({nudged(k), nudged((k + 1) % a.size())});
    find_regions();
    return regions_;
}

// The outline is cut along the sides of the box, one after the other; where it falls apart its parts stay tied along a
// side, which adds nothing.
double OverlapArea::area(std::span<const Vec2, 4> a, const PolarPolygon& b) {
    loop_.clear();
    for (int k = 0; k < b.size(); ++k) loop_.push_back(b.vertex(k));
    for (std::size_t k = 0; k < a.size(); ++k) {
        const Vec2 along = a[(k + 1) % a.size()] - a[k];
        std::swap(loop_, uncut_);
        loop_.clear();
        for (std::size_t j = 0; j < uncut_.size(); ++j) {
            const Vec2& from = uncut_[j];
            const Vec2& to = uncut_[j + 1 == uncut_.size() ? 0 : j + 1];
            const double left_from = cross(along, from - a[k]);
            const double left_to = cross(along, to - a[k]);
            if (left_from >= 0.0) loop_.push_back(from);
            if ((left_from >= 0.0) == (left_to >= 0.0)) continue;
            loop_.emplace_back(from + left_from / (left_from - left_to) * (to - from));
        }
    }
    double area = 0.0;
    for (std::size_t j = 0; j < loop_.size(); ++j) {
        area += 0.5 * cross(loop_[j] - loop_[0], loop_[j + 1 == loop_.size() ? 0 : j + 1] - loop_[0]);
    }
    return area;
}

void OverlapArea::find_regions() {
    find_crossings();
    // An odd number is round-off: outlines that touch without crossing. Nothing measurable is lost with it.
    if (crossings_.size() < 2 || crossings_.size() % 2 != 0) return;
    link_crossings();
    for (std::size_t c = 0; c < crossings_.size(); ++c) {
        if (crossings_[c].enters && !crossings_[c].used) follow_loop(c);
    }
}

// Two edges cross where each has its ends on different sides of the other's line. A vertex on a line counts as on its
// left for both edges that meet in it, so that an outline crosses a line an even number of times.
void OverlapArea::find_crossings() {
    crossings_.clear();
    for (std::size_t i = 0; i < a_.size(); ++i) {
        const Vec2 p = a_[i].from;
        const Vec2 way_a = a_[i].to - p;
        for (std::size_t j = 0; j < b_.size(); ++j) {
            const Vec2 q = b_[j].from;
            const Vec2 way_b = b_[j].to - q;
            const double from_side = cross(way_b, p - q);
            const double to_side = cross(way_b, a_[i].to - q);
            if ((from_side < 0.0) == (to_side < 0.0)) continue;
            const double b_from = cross(way_a, q - p);
            const double b_to = cross(way_a, b_[j].to - p);
            if ((b_from < 0.0) == (b_to < 0.0)) continue;
            const double along = from_side / (from_side - to_side);
            crossings_.push_back({static_cast<int>(i), static_cast<int>(j), along, b_from / (b_from - b_to),
                                  p + along * way_a, from_side < 0.0, 0, 0, false});
        }
    }
}

void OverlapArea::link_crossings() {
    const auto link = [this](auto key, int Crossing::*next) {
        order_.resize(crossings_.size());
        for (std::size_t c = 0; c < order_.size(); ++c) order_[c] = static_cast<int>(c);
        const auto at = [this](int c) -> Crossing& { return crossings_[static_cast<std::size_t>(c)]; };
        std::sort(order_.begin(), order_.end(), [&](int c, int d) { return key(at(c)) < key(at(d)); });
        for (std::size_t c = 0; c < order_.size(); ++c) at(order_[c]).*next = order_[(c + 1) % order_.size()];
    };
    link([](const Crossing& c) { return std::pair{c.edge_a, c.along_a}; }, &Crossing::next_on_a);
    link([](const Crossing& c) { return std::pair{c.edge_b, c.along_b}; }, &Crossing::next_on_b);
}

// Appends the corners that the outline turns on the way from one of its crossings to another; false where the gathered
// edges do not lead there.
bool OverlapArea::walk(const std::vector<OutlineEdge>& edges, int first, double along_first, int last,
                       double along_last) {
    if (first == last && along_last >= along_first) return true;
    const auto count = static_cast<int>(edges.size());
    for (int k = first, steps = 0; steps < count; ++steps) {
        loop_.push_back(edges[static_cast<std::size_t>(k)].to);
        k = k + 1 == count ? 0 : k + 1;
        if (edges[static_cast<std::size_t>(k)].from != loop_.back()) return false;
        if (k == last) return true;
    }
    return false;
}

void OverlapArea::follow_loop(std::size_t start) {
    loop_.clear();
    Vec2 turned = Vec2::Zero();  // integral of a's outward normal over its outline inside b
    double moment = 0.0;         // of the same about the frame's origin
    Vec2 middles = Vec2::Zero();
    std::size_t c = start;
    int pieces = 0;
    do {
        Crossing& entry = crossings_[c];
        Crossing& exit = crossings_[static_cast<std::size_t>(entry.next_on_a)];
        if (entry.used || !entry.enters || exit.enters) return;
        entry.used = true;
        loop_.push_back(entry.point);
        if (!walk(a_, entry.edge_a, entry.along_a, exit.edge_a, exit.along_a)) return;
        loop_.push_back(exit.point);
        const Crossing& next = crossings_[static_cast<std::size_t>(exit.next_on_b)];
        if (!walk(b_, exit.edge_b, exit.along_b, next.edge_b, next.along_b)) return;
        const Vec2 piece = right_normal(exit.point - entry.point);
        const Vec2 middle = 0.5 * (entry.point + exit.point);
        turned += piece;
        moment += cross(middle, piece);
        middles += middle;
        ++pieces;
        c = static_cast<std::size_t>(exit.next_on_b);
    } while (c != start);

    OverlapRegion region;
    region.width = std::sqrt(turned.squaredNorm());
    if (!(region.width > 0.0)) return;
    region.normal = turned / region.width;
    const Vec2 about = middles / pieces;
    region.point = about + right_normal(region.normal) * (moment / region.width - cross(about, region.normal));
    double low = 0.0;
    double high = 0.0;
    for (std::size_t k = 0; k < loop_.size(); ++k) {
        const Vec2 p = loop_[k] - loop_[0];
        region.area += 0.5 * cross(p, loop_[k + 1 == loop_.size() ? 0 : k + 1] - loop_[0]);
        const double station = region.normal.dot(p);
        low = std::min(low, station);
        high = std::max(high, station);
    }
    region.depth = high - low;
    if (region.area > 0.0 && region.depth > k_of_the_nudge * region.width) regions_.push_back(region);
}

}  // namespace polargrain
