#include "src/detect/contact_normal.h"

#include <cmath>
#include <optional>

#include "src/detect/boundary.h"

namespace polargrain {

namespace {

/// Unit normal of the chord from m to n on the side away from the other's centre of mass (its own frame); where the
/// chord runs through the centre, on the side of the penetrated edge's normal. None for a chord of no length.
std::optional<Vec2> chord_normal(const Vec2& m, const Vec2& n, const Vec2& edge_normal, double tolerance) {
    const Vec2 chord = n - m;
    const double length = std::sqrt(chord.squaredNorm());
    if (!(length > tolerance)) return std::nullopt;
    const Vec2 direction = right_normal(chord) / length;
    const double away = direction.dot(m);
    const double side = std::abs(away) > tolerance ? away : direction.dot(edge_normal);
    return side < 0.0 ? Vec2(-direction) : direction;
}

/// (d): the two vertices of the other inside the owner that are farthest apart; on ties the first pair.
std::pair<int, int> widest_pair(const PolarPolygon& other, std::span<const InsideVertex> inside) {
    std::pair<int, int> widest{inside[0].vertex, inside[1].vertex};
    double width = -1.0;
    for (std::size_t a = 0; a < inside.size(); ++a) {
        for (std::size_t b = a + 1; b < inside.size(); ++b) {
            const double d = (other.vertex(inside[a].vertex) - other.vertex(inside[b].vertex)).squaredNorm();
            if (d > width) {
                width = d;
                widest = {inside[a].vertex, inside[b].vertex};
            }
        }
    }
    return widest;
}

/// Edges of the other through which the owner's outline passes on either side of the contact vertex.
struct Crossing {
    int entry;  ///< met walking the owner clockwise from the contact vertex
    int exit;   ///< met walking it counter-clockwise
};

/// Walks the owner from the contact vertex to the first vertex outside, and finds the edge that was crossed.
template <typename Advance>
std::optional<int> crossed_edge(const PolarPolygon& owner, const PolarPolygon& other, const Pose& relative, int from,
                                double tolerance, Advance advance) {
    Vec2 inside = relative.to_world(owner.vertex(from));
    for (int k = advance(from); k != from; k = advance(k)) {
        const Vec2 p = relative.to_world(owner.vertex(k));
        if (!(other.depth(p) > tolerance)) return exit_edge(other, inside, p);
        inside = p;
    }
    return std::nullopt;
}

std::optional<Crossing> crossed_edges(const PolarPolygon& owner, const PolarPolygon& other, const Pose& relative,
                                      int from, double tolerance) {
    const auto exit = crossed_edge(owner, other, relative, from, tolerance, [&](int k) { return owner.next(k); });
    if (!exit) return std::nullopt;
    const auto entry = crossed_edge(owner, other, relative, from, tolerance, [&](int k) { return owner.previous(k); });
    if (!entry) return std::nullopt;
    return Crossing{*entry, *exit};
}

}  // namespace

const char* to_string(NormalCase which) {
    switch (which) {
        case NormalCase::flat: return "flat (a)";
        case NormalCase::corner: return "corner (b)";
        case NormalCase::multi_owner: return "several vertices of the owner (c)";
        case NormalCase::multi_other: return "several vertices of the other (d)";
        case NormalCase::edge: return "penetrated edge";
    }
    return "unknown";
}

Vec2 penetrated_edge_normal(const PolarPolygon& other, const Pose& other_pose, const InsideVertex& contact) {
    return other_pose.turned(other.normal(contact.sector));
}

ContactNormal contact_normal(const PolarPolygon& owner, const Pose& owner_pose, const PolarPolygon& other,
                             const Pose& other_pose, const InsideVertex& contact,
                             std::span<const InsideVertex> owner_inside, std::span<const InsideVertex> other_inside,
                             double tolerance) {
    const Vec2 edge_normal = other.normal(contact.sector);
    const ContactNormal of_edge{other_pose.turned(edge_normal), NormalCase::edge};

    if (other_inside.size() >= 2) {
        const auto [m, n] = widest_pair(other, other_inside);
        const auto normal = chord_normal(other.vertex(m), other.vertex(n), edge_normal, tolerance);
        return normal ? ContactNormal{other_pose.turned(*normal), NormalCase::multi_other} : of_edge;
    }
    const auto crossing = crossed_edges(owner, other, owner_pose.relative_to(other_pose), contact.vertex, tolerance);
    if (!crossing) return of_edge;
    if (crossing->entry == crossing->exit) {
        return {other_pose.turned(other.normal(crossing->entry)), NormalCase::flat};
    }
    // Going round the common region counter-clockwise, the other's outline is followed from the owner's exit to its
    // entry: the outer ends are the start of the exit edge and the end of the entry edge.
    const Vec2 m = other.vertex(crossing->exit);
    const Vec2 n = other.vertex(other.next(crossing->entry));
    const auto normal = chord_normal(m, n, edge_normal, tolerance);
    if (!normal) return of_edge;
    return {other_pose.turned(*normal), owner_inside.size() >= 2 ? NormalCase::multi_owner : NormalCase::corner};
}

}  // namespace polargrain
