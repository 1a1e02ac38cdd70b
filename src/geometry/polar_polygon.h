#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "src/core/vec2.h"
#include "src/geometry/mass_properties.h"

namespace polargrain {

/// Outline of a grain in polar form about its centre of mass. [HN94, sec. 3.3, Fig. 2]
///
/// Vertices run counter-clockwise in the grain's own frame, whose origin is the centre of mass; vertex q and the
/// next one bound sector q, the triangle with the origin. Invariant: every sector has positive area and the
/// sectors go round once (the outline is star-shaped about its centre of mass); it may be non-convex.
/// Immutable, to be shared between grains.
class PolarPolygon {
public:
    static constexpr int k_max_vertices = 65534;

    struct PolarVertex {
        double r;      ///< [m]
        double theta;  ///< [rad], in (-pi, pi]
    };

    /// vertices [m]: about the centre of mass, counter-clockwise, three to k_max_vertices.
    /// mass: of the same outline; its centroid is taken to be the origin.
    /// Throws InputError naming the first vertex at which the outline is not star-shaped.
    PolarPolygon(std::string name, std::span<const Vec2> vertices, const MassProperties& mass);

    const std::string& name() const { return name_; }
    int size() const { return size_; }
    double area() const { return area_; }
    double polar_moment() const { return polar_moment_; }

    /// Largest vertex radius: no point of the grain is farther out.
    double outer_radius() const { return outer_radius_; }
    /// Least distance from the centre of mass to an edge: every point nearer is inside.
    double inner_radius() const { return inner_radius_; }

    /// A point outside whose distance from the line of its sector's edge is at least g is at least evenness() g away
    /// from the outline: the least over the largest distance of an edge's line from the centre of mass.
    double evenness() const { return evenness_; }

    Vec2 vertex(int q) const { return {x()[q], y()[q]}; }
    /// Outward unit normal of edge q, from vertex q to the next.
    Vec2 normal(int q) const {
        return {(y()[q + 1] - y()[q]) * inverse_length()[q], (x()[q] - x()[q + 1]) * inverse_length()[q]};
    }
    /// Distance of the line of edge q from the centre of mass; positive.
    double offset(int q) const { return (x()[q] * y()[q + 1] - y()[q] * x()[q + 1]) * inverse_length()[q]; }
    int next(int q) const { return q + 1 == size_ ? 0 : q + 1; }
    int previous(int q) const { return q == 0 ? size_ - 1 : q - 1; }
    PolarVertex polar_vertex(int q) const;
    std::vector<Vec2> vertices() const;

    /// Coordinates as arrays of size() + 1 numbers, the first vertex repeated at the end.
    const double* x() const { return data_.data(); }
    const double* y() const { return data_.data() + stride(); }

    /// Sector that holds the direction of p (grain's frame); a ray through a vertex belongs to the sector that begins
    /// there, and p = 0 counts as on the positive x axis.
    /// Cost: O(1) on average: a table over a pseudo-angle that needs no arc tangent, then a short forward scan.
    int sector_of(const Vec2& p) const;

    /// How deep the point p (grain's frame) lies behind the edge of its sector [m]: positive inside, negative
    /// outside. Same sign as the triangle test of [HN94, sec. 3.4.1, Fig. 5], and a length besides.
    double depth(const Vec2& p) const { return depth(p, sector_of(p)); }
    double depth(const Vec2& p, int sector) const {
        const double* px = x() + sector;
        const double* py = y() + sector;
        return ((px[0] - p.x()) * (py[1] - py[0]) - (py[0] - p.y()) * (px[1] - px[0])) * inverse_length()[sector];
    }

    /// The same outline, larger by the factor: finite and positive, else InputError.
    PolarPolygon scaled(double factor, std::string name) const;

private:
    static constexpr int k_narrow = 256;  // so many sectors can be told apart by a byte

    void fill_tables(std::span<const Vec2> vertices);
    void check_star_shape() const;
    void find_evenness();
    void build_sector_table();
    static double pseudo_angle(const Vec2& p);
    int first_in_bin(int bin) const;

    std::ptrdiff_t stride() const { return size_ + 1; }
    const double* inverse_length() const { return data_.data() + 2 * stride(); }

    std::string name_;
    int size_ = 0;
    int bins_ = 0;
    double area_ = 0.0, polar_moment_ = 0.0, outer_radius_ = 0.0, inner_radius_ = 0.0, evenness_ = 0.0;
    std::vector<double> data_;  // x, y, inverse edge length, each size_ + 1 long: no more, as grains with shapes of
                                // their own carry one each
    std::vector<std::uint8_t> sectors_;  // see first_in_bin; a byte a bin, or two where a byte is too short
};

// Rises with the angle from 0 at the positive x axis to 4 after a full turn (the "diamond angle"): 1 - t above the axis
// and 3 + t below, in a form without a branch, as no predictor can know on which side a vertex lies.
inline double PolarPolygon::pseudo_angle(const Vec2& p) {
    const double sum = std::abs(p.x()) + std::abs(p.y());
    if (!(sum > 0.0)) return 0.0;
    const double side = std::copysign(1.0, p.y());
    return (2.0 - side) - side * (p.x() / sum);
}

// Sector that holds the lower bound of a bin of the pseudo-angle.
inline int PolarPolygon::first_in_bin(int bin) const {
    const auto b = static_cast<std::size_t>(bin);
    return size_ <= k_narrow ? sectors_[b] : sectors_[2 * b] | (sectors_[2 * b + 1] << 8);
}

inline int PolarPolygon::sector_of(const Vec2& p) const {
    const int bin = std::min(static_cast<int>(pseudo_angle(p) * (0.25 * bins_)), bins_ - 1);
    const double* px = x();
    const double* py = y();
    int q = first_in_bin(bin);
    // Forward while p lies on or beyond the far ray of the sector. Whether by one is as good as chance, so that it is
    // reckoned; by more is rare. Bounded, for p = 0 and for slivers.
    q += static_cast<int>(px[q + 1] * p.y() - py[q + 1] * p.x() >= 0.0);
    q -= size_ & -static_cast<int>(q == size_);
    for (int tries = 1; tries < size_ && px[q + 1] * p.y() - py[q + 1] * p.x() >= 0.0; ++tries) q = next(q);
    // Round-off can place a point just short of a ray one bin too far.
    for (int tries = 0; tries < size_ && px[q] * p.y() - py[q] * p.x() < 0.0; ++tries) q = previous(q);
    return q;
}

}  // namespace polargrain
