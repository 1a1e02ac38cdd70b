#include "src/geometry/polar_polygon.h"

#include <bit>
#include <limits>

#include "src/core/error.h"

namespace polargrain {

PolarPolygon::PolarPolygon(std::string name, std::span<const Vec2> vertices, const MassProperties& mass)
    : name_(std::move(name)), area_(mass.area), polar_moment_(mass.polar_moment) {
    require(vertices.size() >= 3, "shape \"{}\" has {} vertices: give at least 3", name_, vertices.size());
    require(vertices.size() <= k_max_vertices, "shape \"{}\" has {} vertices: give {} at most", name_, vertices.size(),
            k_max_vertices);
    size_ = static_cast<int>(vertices.size());
    fill_tables(vertices);
    check_star_shape();
    find_evenness();
    build_sector_table();
}

void PolarPolygon::fill_tables(std::span<const Vec2> vertices) {
    data_.resize(static_cast<std::size_t>(3 * stride()));
    double* px = data_.data();
    double* py = px + stride();
    double* inverse_length = py + stride();
    inner_radius_ = std::numeric_limits<double>::infinity();
    for (int q = 0; q <= size_; ++q) {
        const Vec2& a = vertices[static_cast<std::size_t>(q % size_)];
        const Vec2& b = vertices[static_cast<std::size_t>((q + 1) % size_)];
        px[q] = a.x();
        py[q] = a.y();
        inverse_length[q] = 1.0 / std::sqrt((b - a).squaredNorm());
        outer_radius_ = std::max(outer_radius_, std::sqrt(a.squaredNorm()));
        const double along = std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        inner_radius_ = std::min(inner_radius_, std::sqrt((a + along * (b - a)).squaredNorm()));
    }
}

/// Why evenness() holds: the factor by which a point lies farther out than the outline in its direction is continuous,
/// and within a sector changes by at most 1 / offset per length.
void PolarPolygon::find_evenness() {
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (int q = 0; q < size_; ++q) {
        least = std::min(least, offset(q));
        largest = std::max(largest, offset(q));
    }
    evenness_ = least / largest;
}

void PolarPolygon::check_star_shape() const {
    int turns = 0;  // times the outline crosses the positive x axis upwards
    for (int q = 0; q < size_; ++q) {
        const Vec2 a{x()[q], y()[q]};
        const Vec2 b{x()[q + 1], y()[q + 1]};
        require(cross(a, b) > 0.0,
                "shape \"{}\": vertex {} turns back: the outline is not star-shaped about its centre of mass "
                "(split the grain, or move the vertex)",
                name_, next(q));
        if (a.y() < 0.0 && b.y() >= 0.0) ++turns;
    }
    require(turns == 1, "shape \"{}\": the outline winds {} times round its centre of mass: it crosses itself", name_,
            turns);
}

void PolarPolygon::build_sector_table() {
    const bool wide = size_ > k_narrow;
    bins_ = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(2 * size_, 16))));
    sectors_.reserve(static_cast<std::size_t>(wide ? 2 * bins_ : bins_));
    // The sector that holds direction 0; as no sector reaches half a turn, exactly one passes.
    const Vec2 ahead{1.0, 0.0};
    int sector = 0;
    while (!(cross(vertex(sector), ahead) >= 0.0 && cross(ahead, vertex(next(sector))) > 0.0)) {
        ++sector;
        PG_ASSERT(sector < size_, "no sector of {} holds direction 0", name_);
    }
    for (int b = 0; b < bins_; ++b) {
        // Direction at the lower bound of the bin, the inverse of pseudo_angle.
        const double a = 4.0 * b / bins_;
        const Vec2 direction =
            a < 2.0 ? Vec2(1.0 - a, 1.0 - std::abs(1.0 - a)) : Vec2(a - 3.0, -(1.0 - std::abs(a - 3.0)));
        for (int tries = 0; tries < size_ && cross(vertex(next(sector)), direction) >= 0.0; ++tries) {
            sector = next(sector);
        }
        sectors_.push_back(static_cast<std::uint8_t>(sector & 0xff));
        if (wide) sectors_.push_back(static_cast<std::uint8_t>(sector >> 8));
    }
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
    require(std::isfinite(factor) && factor > 0.0, "shape \"{}\": scale is {}: give a finite number above 0", name_,
            factor);
    std::vector<Vec2> larger = vertices();
    for (Vec2& v : larger) v *= factor;
    const double f2 = factor * factor;
    return {std::move(name), larger, {area_ * f2, Vec2::Zero(), polar_moment_ * f2 * f2}};
}

}  // namespace polargrain
