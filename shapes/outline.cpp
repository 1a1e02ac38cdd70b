#include "shapes/outline.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpzf.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "src/core/error.h"

namespace polargrain {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Segment = Kernel::Segment_2;
using Exact = CGAL::Gmpzf;  // m 2^e with integers of any length: sums and products of doubles without rounding
using Edges = std::pair<std::size_t, std::size_t>;

// A number as the sum of two doubles, good to twice the digits of one.
struct DoubleLength {
    double high = 0.0, low = 0.0;

    double minus_this(double value) const {
        const double difference = value - high;
        const double back = difference - value;
        const double lost = (value - (difference - back)) - (high + back);
        return difference + (lost - low);
    }
};

struct ExactIntegrals {
    double area = 0.0, polar_moment = 0.0;
    DoubleLength centroid_x, centroid_y;
    bool clockwise = false;
};

double ratio(const Exact& numerator, const Exact& denominator) {
    const auto [n, n_exponent] = numerator.to_double_exp();
    const auto [d, d_exponent] = denominator.to_double_exp();
    return std::ldexp(n / d, static_cast<int>(n_exponent - d_exponent));
}

DoubleLength double_length_ratio(const Exact& numerator, const Exact& denominator) {
    const double high = ratio(numerator, denominator);
    return {high, ratio(numerator - Exact(high) * denominator, denominator)};
}

// Green's theorem, summed without rounding, so that neither the order of the points nor their distance from the origin
// costs a digit. None where the area is zero.
std::optional<ExactIntegrals> integrate(std::span<const Vec2> points) {
    Exact area2, moment_x6, moment_y6, polar12;
    Exact ax(points.back().x()), ay(points.back().y());
    for (const Vec2& point : points) {
        const Exact bx(point.x()), by(point.y());
        const Exact cross = ax * by - ay * bx;
        const Exact sum_x = ax + bx, sum_y = ay + by;
        area2 += cross;
        moment_x6 += sum_x * cross;
        moment_y6 += sum_y * cross;
        polar12 += (sum_x * sum_x - ax * bx + sum_y * sum_y - ay * by) * cross;
        ax = bx;
        ay = by;
    }
    if (area2.is_zero()) return std::nullopt;
    const Exact area6 = Exact(3) * area2;
    const Exact about_centroid =
        area6 * polar12 - Exact(2) * (moment_x6 * moment_x6 + moment_y6 * moment_y6);  // 36 area2 x polar moment
    return ExactIntegrals{.area = 0.5 * std::abs(ratio(area2, Exact(1))),
                          .polar_moment = std::abs(ratio(about_centroid, Exact(36) * area2)),
                          .centroid_x = double_length_ratio(moment_x6, area6),
                          .centroid_y = double_length_ratio(moment_y6, area6),
                          .clockwise = area2.sign() == CGAL::NEGATIVE};
}

std::vector<Point> as_cgal(std::span<const Vec2> points) {
    std::vector<Point> converted;
    converted.reserve(points.size());
    for (const Vec2& p : points) converted.emplace_back(p.x(), p.y());
    return converted;
}

// Edge q runs from point q to the next one.
bool neighbours_fold(const Point& before, const Point& shared, const Point& after) {
    return CGAL::collinear(before, shared, after) && CGAL::angle(before, shared, after) == CGAL::ACUTE;
}

// The first two edges that meet elsewhere than at the point where neighbours join. All pairs: only for a message.
std::optional<Edges> crossing_edges(const std::vector<Point>& points) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Segment first(points[i], points[(i + 1) % n]);
        const CGAL::Bbox_2 box = first.bbox();
        for (std::size_t j = i + 1; j < n; ++j) {
            const Segment second(points[j], points[(j + 1) % n]);
            const bool follows = j == i + 1;
            const bool precedes = i == 0 && j == n - 1;
            const bool meet = follows    ? neighbours_fold(points[i], points[j], points[(j + 1) % n])
                              : precedes ? neighbours_fold(points[j], points[0], points[1])
                                         : CGAL::do_overlap(box, second.bbox()) && CGAL::do_intersect(first, second);
            if (meet) return Edges{i, j};
        }
    }
    return std::nullopt;
}

std::string edge_name(std::size_t edge, std::size_t n) { return fmt::format("{}-{}", edge, (edge + 1) % n); }

void require_simple(const std::string& name, std::span<const Vec2> points) {
    const std::vector<Point> outline = as_cgal(points);
    if (CGAL::is_simple_2(outline.begin(), outline.end(), Kernel())) return;
    const std::size_t n = points.size();
    const auto edges = crossing_edges(outline);
    if (edges) {
        throw InputError(fmt::format(
            "shape \"{}\": the outline crosses or touches itself: edge {} meets edge {} (vertices count from 0); "
            "move a vertex, or give the points in the order in which they follow one another round the grain",
            name, edge_name(edges->first, n), edge_name(edges->second, n)));
    }
    broken_invariant("an outline that is not simple has two edges that meet", __FILE__, __LINE__, name);
}

void check_points(const std::string& name, std::span<const Vec2> points) {
    require(points.size() >= 3, "shape \"{}\" has {} points: give at least 3", name, points.size());
    require(points.size() <= PolarPolygon::k_max_vertices, "shape \"{}\" has {} points: give {} at most", name,
            points.size(), PolarPolygon::k_max_vertices);
    for (std::size_t i = 0; i < points.size(); ++i) {
        require(points[i].allFinite(), "shape \"{}\": point {} is ({}, {}): give finite numbers", name, i,
                points[i].x(), points[i].y());
    }
    require(points.front() != points.back(),
            "shape \"{}\": the last point repeats the first one: leave it out, an outline closes by itself", name);
    for (std::size_t i = 1; i < points.size(); ++i) {
        require(points[i] != points[i - 1], "shape \"{}\": point {} repeats point {}: leave one out", name, i, i - 1);
    }
}

ExactIntegrals checked_integrals(const std::string& name, std::span<const Vec2> points) {
    const auto integrals = integrate(points);
    if (!integrals) require_simple(name, points);  // an outline without area crosses or folds back on itself
    require(integrals && std::isnormal(integrals->area) && std::isnormal(integrals->polar_moment),
            "shape \"{}\": the area or the polar moment cannot be represented: check the unit of its points", name);
    return *integrals;
}

// Does the step from a to b go counter-clockwise about the origin? Exactly, and in floating point as well, since that
// is what the sector look-up computes with.
bool goes_round(const Vec2& a, const Vec2& b) {
    return CGAL::orientation(Point(0.0, 0.0), Point(a.x(), a.y()), Point(b.x(), b.y())) == CGAL::LEFT_TURN &&
           cross(a, b) > 0.0;
}

// Index in the order given of the first vertex at which a counter-clockwise traversal turns back, if any.
std::optional<std::size_t> first_turning_back(const std::vector<Vec2>& local, bool was_clockwise) {
    const std::size_t n = local.size();
    for (std::size_t q = 0; q < n; ++q) {
        const std::size_t end = (q + 1) % n;
        if (!goes_round(local[q], local[end])) return was_clockwise ? n - 1 - end : end;
    }
    return std::nullopt;
}

int turns_about_origin(const std::vector<Vec2>& local) {
    int turns = 0;
    for (std::size_t q = 0; q < local.size(); ++q) {
        if (local[q].y() < 0.0 && local[(q + 1) % local.size()].y() >= 0.0) ++turns;
    }
    return turns;
}

// An outline about its own centroid, counter-clockwise, and what is known of it.
struct Centred {
    ExactIntegrals exact;
    std::vector<Vec2> local;
    std::optional<std::size_t> turning_back;  // vertex as given

    // Sectors that all go forward and close after one turn cannot overlap: such an outline is also simple.
    bool star_shaped() const { return !turning_back && turns_about_origin(local) == 1; }
};

Centred centred(const std::string& name, std::span<const Vec2> points) {
    check_points(name, points);
    Centred outline{.exact = checked_integrals(name, points), .local = {}, .turning_back = {}};
    const ExactIntegrals& exact = outline.exact;
    outline.local.reserve(points.size());
    for (const Vec2& p : points) {
        outline.local.emplace_back(exact.centroid_x.minus_this(p.x()), exact.centroid_y.minus_this(p.y()));
    }
    if (exact.clockwise) std::reverse(outline.local.begin(), outline.local.end());
    outline.turning_back = first_turning_back(outline.local, exact.clockwise);
    return outline;
}

PolarPolygon polygon_of(const std::string& name, const Centred& outline) {
    return {name, outline.local, {outline.exact.area, Vec2::Zero(), outline.exact.polar_moment}};
}

}  // namespace

MassProperties mass_properties(const std::string& name, std::span<const Vec2> points) {
    check_points(name, points);
    require_simple(name, points);
    const ExactIntegrals exact = checked_integrals(name, points);
    return {exact.area, {exact.centroid_x.high, exact.centroid_y.high}, exact.polar_moment};
}

PolarPolygon prepare_outline(const std::string& name, std::span<const Vec2> points) {
    const Centred outline = centred(name, points);
    if (!outline.star_shaped()) {
        require_simple(name, points);  // the better explanation, where it applies
        PG_ASSERT(outline.turning_back, "{} winds {} times", name, turns_about_origin(outline.local));
        const std::size_t vertex = outline.turning_back.value();
        throw InputError(fmt::format(
            "shape \"{}\": vertex {} (counted from 0) at ({}, {}) turns back as seen from the centre of mass ({}, {}): "
            "the outline is not star-shaped about it (split the grain, or move the vertex)",
            name, vertex, points[vertex].x(), points[vertex].y(), outline.exact.centroid_x.high,
            outline.exact.centroid_y.high));
    }
    return polygon_of(name, outline);
}

std::optional<PolarPolygon> try_prepare_outline(const std::string& name, std::span<const Vec2> points) {
    const Centred outline = centred(name, points);
    if (!outline.star_shaped()) return std::nullopt;
    return polygon_of(name, outline);
}

}  // namespace polargrain
