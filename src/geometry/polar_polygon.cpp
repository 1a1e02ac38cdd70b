#include "src/geometry/polar_polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "src/core/error.h"

namespace polargrain {

namespace {

// Rises with the angle from 0 at the positive x axis to 4 after a full turn (the "diamond angle").
double pseudo_angle(double x, double y) {
    const double sum = std::abs(x) + std::abs(y);
    if (!(sum > 0.0)) return 0.0;
    const double t = x / sum;
    return y >= 0.0 ? 1.0 - t : 3.0 + t;
}

int bin_of(double x, double y, int bins) {
    const int b = static_cast<int>(pseudo_angle(x, y) * (0.25 * bins));
    return std::min(b, bins - 1);
}

}  // namespace

PolarPolygon::PolarPolygon(std::string name, std::span<const Vec2> vertices, const MassProperties& mass)
    : name_(std::move(name)),
      size_(static_cast<int>(vertices.size())),
      area_(mass.area),
      polar_moment_(mass.polar_moment) {
    require(size_ >= 3, "shape \"{}\" has {} vertices: give at least 3", name_, size_);
    require(size_ < std::numeric_limits<std::uint16_t>::max(), "shape \"{}\" has {} vertices: give fewer than {}",
            name_, size_, std::numeric_limits<std::uint16_t>::max());

    data_.resize(static_cast<std::size_t>(4 * stride()));
    double* px = data_.data();
    double* py = px + stride();
    double* nx = py + stride();
    double* ny = nx + stride();
    for (int q = 0; q <= size_; ++q) {
        px[q] = vertices[static_cast<std::size_t>(q % size_)].x();
        py[q] = vertices[static_cast<std::size_t>(q % size_)].y();
    }
    int turns = 0;  // times the outline crosses the positive x axis upwards
    inner_radius_ = std::numeric_limits<double>::infinity();
    for (int q = 0; q < size_; ++q) {
        const Vec2 a{px[q], py[q]};
        const Vec2 b{px[q + 1], py[q + 1]};
        require(cross(a, b) > 0.0,
                "shape \"{}\": vertex {} turns back: the outline is not star-shaped about its centre of mass "
                "(split the grain, or move the vertex)",
                name_, q + 1 == size_ ? 0 : q + 1);
        if (a.y() < 0.0 && b.y() >= 0.0) ++turns;
        const Vec2 n = unit(right_normal(b - a));
        nx[q] = n.x();
        ny[q] = n.y();
        outer_radius_ = std::max(outer_radius_, std::sqrt(a.squaredNorm()));
        const double along = std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        inner_radius_ = std::min(inner_radius_, std::sqrt((a + along * (b - a)).squaredNorm()));
    }
    nx[size_] = nx[0];
    ny[size_] = ny[0];
    require(turns == 1, "shape \"{}\": the outline winds {} times round its centre of mass: it crosses itself", name_,
            turns);
    build_sector_table();
}

void PolarPolygon::build_sector_table() {
    const int bins = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(2 * size_, 16))));
    first_in_bin_.resize(static_cast<std::size_t>(bins));
    // The sector that holds direction 0; as no sector reaches half a turn, exactly one passes.
    const Vec2 ahead{1.0, 0.0};
    int sector = 0;
    while (!(cross(vertex(sector), ahead) >= 0.0 && cross(ahead, vertex(next(sector))) > 0.0)) {
        ++sector;
        PG_ASSERT(sector < size_, "no sector of {} holds direction 0", name_);
    }
    for (int b = 0; b < bins; ++b) {
        // Direction at the lower bound of the bin, the inverse of pseudo_angle.
        const double a = 4.0 * b / bins;
        const Vec2 direction =
            a < 2.0 ? Vec2(1.0 - a, 1.0 - std::abs(1.0 - a)) : Vec2(a - 3.0, -(1.0 - std::abs(a - 3.0)));
        for (int tries = 0; tries < size_ && cross(direction, vertex(next(sector))) <= 0.0; ++tries) {
            sector = next(sector);
        }
        first_in_bin_[static_cast<std::size_t>(b)] = static_cast<std::uint16_t>(sector);
    }
}

int PolarPolygon::sector_of(const Vec2& p) const {
    const int bins = static_cast<int>(first_in_bin_.size());
    int q = first_in_bin_[static_cast<std::size_t>(bin_of(p.x(), p.y(), bins))];
    const double* px = x();
    const double* py = y();
    // Forward while p lies beyond the far ray of the sector. Bounded, for p = 0 and for round-off.
    for (int tries = 0; tries < size_; ++tries) {
        if (px[q + 1] * p.y() - py[q + 1] * p.x() <= 0.0) break;
        q = next(q);
    }
    // Round-off can place a point that lies on a ray one bin too far; then the sector before holds it.
    if (px[q] * p.y() - py[q] * p.x() < 0.0) {
        const int before = previous(q);
        if (px[before] * p.y() - py[before] * p.x() >= 0.0) q = before;
    }
    return q;
}

PolarPolygon::PolarVertex PolarPolygon::polar_vertex(int q) const {
    const Vec2 v = vertex(q);
    return {std::sqrt(v.squaredNorm()), std::atan2(v.y(), v.x())};
}

std::vector<Vec2> PolarPolygon::vertices() const {
    std::vector<Vec2> all;
    all.reserve(static_cast<std::size_t>(size_));
    for (int q = 0; q < size_; ++q) all.push_back(vertex(q));
    return all;
}

PolarPolygon PolarPolygon::scaled(double factor, std::string name) const {
    std::vector<Vec2> larger = vertices();
    for (Vec2& v : larger) v *= factor;
    const double f2 = factor * factor;
    return {std::move(name), larger, {area_ * f2, Vec2::Zero(), polar_moment_ * f2 * f2}};
}

}  // namespace polargrain
