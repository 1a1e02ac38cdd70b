#include "src/detect/contact_finder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/detect/boundary.h"

namespace polargrain {

namespace {

/// A point that might become the contact; normal out of b into a.
struct Candidate {
    Vec2 point;
    Vec2 normal;
    double depth;
    bool approaching;
};

/// The deepest approaching candidate, else the deepest: true where `next` takes the place of `best`. [HN94, 3.4.1]
bool preferred(const Candidate& next, const Candidate& best) {
    if (next.approaching != best.approaching) return next.approaching;
    return next.depth > best.depth;
}

bool approaches(const PlacedShape& a, const PlacedShape& b, const Vec2& point, const Vec2& normal) {
    return (a.velocity_at(point) - b.velocity_at(point)).dot(normal) < 0.0;
}

double tolerance_of(const Shape& a, const Shape& b) {
    return k_touch_tolerance * std::min(outer_radius(a), outer_radius(b));
}

// --- polygon and polygon ---

struct VertexChoice {
    bool owner_is_a = true;
    InsideVertex vertex{};
    Candidate candidate{};
};

/// Best vertex of `owner`, which is a or b, inside `other`.
void choose_vertex(const PlacedShape& a, const PlacedShape& b, bool owner_is_a, const PolarPolygon& owner,
                   const PolarPolygon& other, const std::vector<InsideVertex>& inside,
                   std::optional<VertexChoice>& best) {
    const Pose& owner_pose = owner_is_a ? a.pose : b.pose;
    const Pose& other_pose = owner_is_a ? b.pose : a.pose;
    for (const InsideVertex& v : inside) {
        const Vec2 outward = penetrated_edge_normal(other, other_pose, v);
        const Vec2 point = owner_pose.to_world(owner.vertex(v.vertex));
        const Vec2 normal = owner_is_a ? outward : Vec2(-outward);
        const Candidate next{point, normal, v.depth, approaches(a, b, point, normal)};
        if (!best || preferred(next, best->candidate)) best = VertexChoice{owner_is_a, v, next};
    }
}

/// Points where the outlines cross, world frame.
std::vector<Vec2> crossing_points(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b,
                                  const Pose& pose_b) {
    std::vector<Vec2> points;
    const Pose relative = pose_b.relative_to(pose_a);
    for (int m = 0; m < b.size(); ++m) {
        const Vec2 p = relative.to_world(b.vertex(m));
        const Vec2 along = relative.to_world(b.vertex(b.next(m))) - p;
        for (int k = 0; k < a.size(); ++k) {
            const Vec2 from = a.vertex(k);
            const Vec2 edge = a.vertex(a.next(k)) - from;
            const double denominator = cross(edge, along);
            if (denominator == 0.0) continue;
            const double s = cross(p - from, along) / denominator;
            const double t = cross(p - from, edge) / denominator;
            if (s >= 0.0 && s < 1.0 && t >= 0.0 && t < 1.0) points.push_back(pose_a.to_world(from + s * edge));
        }
    }
    return points;
}

/// Grains that cross although no vertex is inside: the paper's vertex tests do not see them.
std::optional<ContactGeometry> crossing_contact(const PlacedShape& a, const PlacedShape& b, const PolarPolygon& of_a,
                                                const PolarPolygon& of_b) {
    const std::vector<Vec2> points = crossing_points(of_a, a.pose, of_b, b.pose);
    double width = 0.0;
    Vec2 m = Vec2::Zero();
    Vec2 n = Vec2::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            const double d = (points[i] - points[j]).squaredNorm();
            if (d > width) {
                width = d;
                m = points[i];
                n = points[j];
            }
        }
    }
    if (width == 0.0) return std::nullopt;
    const Vec2 across = left_normal(unit(n - m));
    const Vec2 apart = a.pose.centre - b.pose.centre;
    const Vec2 normal = across.dot(apart) < 0.0 ? Vec2(-across) : across;
    return ContactGeometry{0.5 * (m + n), normal, 0.0, NormalCase::edge};
}

std::optional<ContactGeometry> contact_of(const PlacedShape& a, const PolarPolygon& of_a, const PlacedShape& b,
                                          const PolarPolygon& of_b) {
    const double tolerance = tolerance_of(a.shape, b.shape);
    thread_local std::vector<InsideVertex> a_inside;
    thread_local std::vector<InsideVertex> b_inside;
    vertices_inside(of_a, a.pose, of_b, b.pose, tolerance, a_inside, b_inside);
    std::optional<VertexChoice> best;
    choose_vertex(a, b, true, of_a, of_b, a_inside, best);
    choose_vertex(a, b, false, of_b, of_a, b_inside, best);
    if (!best) {
        if (!overlap(a.shape, a.pose, b.shape, b.pose)) return std::nullopt;
        return crossing_contact(a, b, of_a, of_b);
    }

    const ContactNormal normal =
        best->owner_is_a ? contact_normal(of_a, a.pose, of_b, b.pose, best->vertex, a_inside, b_inside, tolerance)
                         : contact_normal(of_b, b.pose, of_a, a.pose, best->vertex, b_inside, a_inside, tolerance);
    ContactGeometry contact{best->candidate.point, best->owner_is_a ? normal.direction : Vec2(-normal.direction),
                            best->candidate.depth, normal.which};
    if (!approaches(a, b, contact.point, contact.normal) && best->candidate.approaching) {
        contact.normal = best->candidate.normal;
        contact.which = NormalCase::edge;
    }
    return contact;
}

// --- disks ---

std::optional<ContactGeometry> contact_of(const PlacedShape& a, const Disk& of_a, const PlacedShape& b,
                                          const Disk& of_b) {
    const Vec2 apart = a.pose.centre - b.pose.centre;
    const double distance = std::sqrt(apart.squaredNorm());
    const double depth = of_a.radius() + of_b.radius() - distance;
    if (!(depth > tolerance_of(a.shape, b.shape))) return std::nullopt;
    const Vec2 normal = distance > 0.0 ? Vec2(apart / distance) : Vec2(Vec2::UnitY());
    return ContactGeometry{b.pose.centre + normal * (of_b.radius() - 0.5 * depth), normal, depth, NormalCase::flat};
}

/// The point of an edge that is nearest to a disk's centre (frame of the outline).
struct Foot {
    int edge;
    double share;  ///< of the edge's length at which the centre stands, unbounded: 0 at its first corner, 1 at the next
    Vec2 point;
    double squared_distance;
};

Foot foot_on(const PolarPolygon& outline, int edge, const Vec2& centre) {
    const Vec2 p = outline.vertex(edge);
    const Vec2 along = outline.vertex(outline.next(edge)) - p;
    const double share = (centre - p).dot(along) / along.squaredNorm();
    const Vec2 point = p + std::clamp(share, 0.0, 1.0) * along;
    return {edge, share, point, (centre - point).squaredNorm()};
}

/// Is a foot, seen from outside, nearer than the outline to both of its sides: on a face that the centre is in front
/// of, or a corner that sticks out towards it? An edge seen from behind only ends there; another one faces the disk.
bool faces(const PolarPolygon& outline, const Foot& foot, double share_before, const Vec2& centre) {
    const Vec2 normal = outline.normal(foot.edge);
    if (foot.share >= 0.0) return foot.share < 1.0 && normal.dot(centre - foot.point) > 0.0;
    return share_before >= 1.0 && cross(outline.normal(outline.previous(foot.edge)), normal) > 0.0;
}

/// a is the disk. One whose centre is inside goes out the nearest way; one outside may touch several faces and corners.
std::optional<ContactGeometry> contact_of(const PlacedShape& a, const Disk& of_a, const PlacedShape& b,
                                          const PolarPolygon& of_b) {
    const double tolerance = tolerance_of(a.shape, b.shape);
    const Vec2 centre = b.pose.to_local(a.pose.centre);
    const double side = of_b.depth(centre) > 0.0 ? -1.0 : 1.0;
    std::optional<Candidate> best;
    const auto consider = [&](const Foot& foot) {
        const double distance = std::sqrt(foot.squared_distance);
        const double depth = of_a.radius() - side * distance;
        if (!(depth > tolerance)) return;
        const Vec2 out =
            distance > tolerance ? Vec2((centre - foot.point) * (side / distance)) : of_b.normal(foot.edge);
        const Vec2 normal = b.pose.turned(out);
        const Vec2 point = b.pose.to_world(foot.point);
        const Candidate next{point, normal, depth, approaches(a, b, point, normal)};
        if (!best || preferred(next, *best)) best = next;
    };
    const double reach = of_a.radius() * of_a.radius();
    Foot nearest = foot_on(of_b, of_b.size() - 1, centre);
    double share_before = nearest.share;
    for (int edge = 0; edge < of_b.size(); ++edge) {
        const Foot foot = foot_on(of_b, edge, centre);
        if (foot.squared_distance < nearest.squared_distance) nearest = foot;
        if (side > 0.0 && foot.squared_distance < reach && faces(of_b, foot, share_before, centre)) consider(foot);
        share_before = foot.share;
    }
    if (!best) consider(nearest);
    if (!best) return std::nullopt;
    return ContactGeometry{best->point, best->normal, best->depth, NormalCase::flat};
}

std::optional<ContactGeometry> contact_of(const PlacedShape& a, const PolarPolygon& of_a, const PlacedShape& b,
                                          const Disk& of_b) {
    auto contact = contact_of(b, of_b, a, of_a);
    if (contact) contact->normal = -contact->normal;
    return contact;
}

// --- walls ---

Vec2 wall_velocity(const Motion& wall, const Vec2& point) { return wall.velocity + cross(wall.spin, point); }

std::optional<ContactGeometry> wall_contact(const PlacedShape& grain, const Disk& disk, const WallPiece& piece,
                                            const Motion&, const Vec2& home) {
    const Vec2 along = piece.b - piece.a;
    const double s = std::clamp((grain.pose.centre - piece.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec2 nearest = piece.a + s * along;
    const Vec2 out = grain.pose.centre - nearest;
    const double distance = std::sqrt(out.squaredNorm());
    if (!(distance < disk.radius() * (1.0 - k_touch_tolerance))) return std::nullopt;
    const Vec2 side = unit(left_normal(along));
    const Vec2 facing = (home - piece.a).dot(side) >= 0.0 ? side : Vec2(-side);
    const bool beside = distance > k_touch_tolerance * disk.radius() && out.dot(home - nearest) > 0.0;
    return ContactGeometry{nearest, beside ? Vec2(out / distance) : facing,
                           beside ? disk.radius() - distance : disk.radius() + distance, NormalCase::flat};
}

std::optional<ContactGeometry> wall_contact(const PlacedShape& grain, const PolarPolygon& outline,
                                            const WallPiece& piece, const Motion& wall, const Vec2& home) {
    if (!overlap(grain.shape, grain.pose, piece)) return std::nullopt;
    const double tolerance = k_touch_tolerance * outline.outer_radius();
    const Vec2 along = piece.b - piece.a;
    const double length = std::sqrt(along.squaredNorm());
    const Vec2 left = left_normal(along) / length;
    const Vec2 facing = (home - piece.a).dot(left) >= 0.0 ? left : Vec2(-left);

    std::optional<Candidate> best;
    const auto consider = [&](const Vec2& point, const Vec2& normal, double depth) {
        const bool closing = (grain.velocity_at(point) - wall_velocity(wall, point)).dot(normal) < 0.0;
        const Candidate next{point, normal, depth, closing};
        if (!best || preferred(next, *best)) best = next;
    };
    for (int k = 0; k < outline.size(); ++k) {
        const Vec2 p = grain.pose.to_world(outline.vertex(k));
        const double depth = -(p - piece.a).dot(facing);
        const double station = (p - piece.a).dot(along) / length;
        if (depth > tolerance && station >= 0.0 && station <= length) consider(p, facing, depth);
    }
    if (!best) {  // the end points of the piece as points in the grain
        for (const Vec2& end : {piece.a, piece.b}) {
            const Vec2 local = grain.pose.to_local(end);
            const int sector = outline.sector_of(local);
            const double depth = outline.depth(local, sector);
            if (depth > tolerance) consider(end, -grain.pose.turned(outline.normal(sector)), depth);
        }
    }
    if (!best) {  // the piece passes through a notch: nothing but the crossing itself is left to hold on to
        const double s = std::clamp((grain.pose.centre - piece.a).dot(along) / (length * length), 0.0, 1.0);
        consider(piece.a + s * along, facing, 0.0);
    }
    return ContactGeometry{best->point, best->normal, best->depth, NormalCase::flat};
}

}  // namespace

std::optional<ContactGeometry> find_contact(const PlacedShape& a, const PlacedShape& b) {
    return std::visit([&](const auto& of_a, const auto& of_b) { return contact_of(a, of_a, b, of_b); }, a.shape,
                      b.shape);
}

std::optional<ContactGeometry> find_contact(const PlacedShape& grain, const WallPiece& piece, const Motion& wall_motion,
                                            const Vec2& home) {
    return std::visit([&](const auto& shape) { return wall_contact(grain, shape, piece, wall_motion, home); },
                      grain.shape);
}

}  // namespace polargrain
