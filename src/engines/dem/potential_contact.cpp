#include "src/engines/dem/potential_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace polargrain {

namespace {

/// A sector of an outline: the triangle of the centre and two vertices, with the gradient of its potential.
struct Sector {
    Vec2 corner[3];
    Vec2 gradient;  ///< [1/m]
};

/// Convex polygon cut by half planes; a triangle cut by three has six corners at most.
struct Piece {
    std::array<Vec2, 8> corner;
    std::size_t count = 0;
};

Piece cut(const Piece& piece, const Vec2& from, const Vec2& to) {
    Piece kept;
    const Vec2 way = to - from;
    for (std::size_t k = 0; k < piece.count; ++k) {
        const Vec2& p = piece.corner[k];
        const Vec2& q = piece.corner[k + 1 == piece.count ? 0 : k + 1];
        const double side_p = cross(way, p - from);
        const double side_q = cross(way, q - from);
        if (side_p >= 0.0) kept.corner[kept.count++] = p;
        if ((side_p < 0.0) != (side_q < 0.0)) kept.corner[kept.count++] = p + side_p / (side_p - side_q) * (q - p);
    }
    return kept;
}

Piece common_part(const Sector& a, const Sector& b) {
    Piece piece;
    piece.count = 3;
    std::copy(std::begin(b.corner), std::end(b.corner), piece.corner.begin());
    for (int k = 0; k < 3 && piece.count > 0; ++k) piece = cut(piece, a.corner[k], a.corner[k == 2 ? 0 : k + 1]);
    return piece;
}

std::vector<Sector> sectors_near(const PolarPolygon& grain, const Pose& pose, const Vec2& other, double other_radius) {
    std::vector<Sector> sectors;
    for (int q = 0; q < grain.size(); ++q) {
        const Vec2 v = pose.to_world(grain.vertex(q));
        const Vec2 w = pose.to_world(grain.vertex(grain.next(q)));
        const Vec2 outward = pose.turned(grain.normal(q));
        const double offset = grain.offset(q);
        const Vec2 low = pose.centre.cwiseMin(v).cwiseMin(w);
        const Vec2 high = pose.centre.cwiseMax(v).cwiseMax(w);
        if ((low - other).maxCoeff() >= other_radius || (other - high).maxCoeff() >= other_radius) continue;
        sectors.push_back({{pose.centre, v, w}, -outward / offset});
    }
    return sectors;
}

/// What the overlaps of pairs of sectors add up to.
struct PotentialSum {
    Vec2 force = Vec2::Zero();  ///< on b
    double moment = 0.0;        ///< of the same about the centre of a
    double area = 0.0;
    double energy = 0.0;
    Vec2 first_moment = Vec2::Zero();
    double deepest = 0.0;

    void add(const Piece& piece, const Sector& s, const Vec2& centre_a, const Sector& t, const Vec2& centre_b,
             double p);
};

void PotentialSum::add(const Piece& piece, const Sector& s, const Vec2& centre_a, const Sector& t, const Vec2& centre_b,
                       double p) {
    double piece_area = 0.0;
    Vec2 weighted = Vec2::Zero();
    for (std::size_t k = 1; k + 1 < piece.count; ++k) {
        const Vec2 e = piece.corner[k] - piece.corner[0];
        const Vec2 f = piece.corner[k + 1] - piece.corner[0];
        const double twice = cross(e, f);
        piece_area += 0.5 * twice;
        weighted += twice / 6.0 * (e + f);
    }
    if (!(piece_area > 0.0)) return;
    const Vec2 centroid = piece.corner[0] + weighted / piece_area;
    const Vec2 density = p * (t.gradient - s.gradient);
    const double phi_a = 1.0 + s.gradient.dot(centroid - centre_a);
    const double phi_b = 1.0 + t.gradient.dot(centroid - centre_b);
    force += piece_area * density;
    moment += piece_area * cross(centroid - centre_a, density);
    energy += p * piece_area * (phi_a + phi_b);
    area += piece_area;
    first_moment += piece_area * (centroid - centre_a);
    for (std::size_t k = 0; k < piece.count; ++k) {
        const Vec2& c = piece.corner[k];
        deepest = std::max(deepest, (1.0 + s.gradient.dot(c - centre_a)) / std::sqrt(s.gradient.squaredNorm()));
        deepest = std::max(deepest, (1.0 + t.gradient.dot(c - centre_b)) / std::sqrt(t.gradient.squaredNorm()));
    }
}

}  // namespace

std::optional<Touch> potential_touch(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b,
                                     const Pose& pose_b, double p) {
    const double reach = a.outer_radius() + b.outer_radius();
    if ((pose_b.centre - pose_a.centre).squaredNorm() >= reach * reach) return {};
    const std::vector<Sector> of_a = sectors_near(a, pose_a, pose_b.centre, b.outer_radius());
    const std::vector<Sector> of_b = sectors_near(b, pose_b, pose_a.centre, a.outer_radius());
    PotentialSum sum;
    for (const Sector& s : of_a) {
        for (const Sector& t : of_b) sum.add(common_part(s, t), s, pose_a.centre, t, pose_b.centre, p);
    }
    const double strength = std::sqrt(sum.force.squaredNorm());
    if (!(strength > 0.0)) return {};
    Touch touch;
    touch.normal = sum.force / strength;
    const Vec2 about = sum.first_moment / sum.area;
    touch.point =
        pose_a.centre + about + right_normal(touch.normal) * (sum.moment / strength - cross(about, touch.normal));
    touch.depth = sum.deepest;
    touch.by_depth = false;
    touch.force = strength;
    touch.energy = sum.energy;
    return touch;
}

}  // namespace polargrain
