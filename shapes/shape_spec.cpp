#include "shapes/shape_spec.h"

#include <algorithm>
#include <cmath>

#include "shapes/outline.h"
#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/core/random.h"

namespace polargrain {

namespace {

using Points = std::vector<Vec2>;

void check_length(const std::string& name, const char* key, double value) {
    require(std::isfinite(value) && value > 0.0, "shape \"{}\": {} is {}: give a finite length above 0 [m]", name, key,
            value);
}

void check_count(const std::string& name, const char* key, int value, int least,
                 int most = PolarPolygon::k_max_vertices) {
    require(value >= least && value <= most, "shape \"{}\": {} is {}: give a whole number from {} to {}", name, key,
            value, least, most);
}

Vec2 at_angle(double radius, double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {radius * cosine, radius * sine};
}

// Direction of the k-th of `count` equal parts of a turn. Worked out within an eighth of a turn, so that directions
// on the axes are exact and mirror images match to the bit.
Vec2 part_of_turn(std::int64_t k, int count) {
    const std::int64_t quarter = 4 * k / count % 4;
    const std::int64_t rest = 4 * k % count;
    const bool past_diagonal = 2 * rest > count;
    const double share = static_cast<double>(past_diagonal ? count - rest : rest) / static_cast<double>(count);
    const auto [s, c] = sine_cosine(0.5 * k_pi * share);
    Vec2 direction = past_diagonal ? Vec2(s, c) : Vec2(c, s);
    switch (quarter) {
        case 0: return direction;
        case 1: return left_normal(direction);
        case 2: return -direction;
        default: return right_normal(direction);
    }
}

struct SideCounts {
    int horizontal = 1, vertical = 1;  ///< pieces that each side is cut into
    bool one_more_at_bottom = false;
};

// Every pair of vertices goes to the pair of sides whose pieces are longest.
SideCounts share_out(const RectangleSpec& spec) {
    SideCounts sides;
    int left = spec.vertices - 4;
    for (; left >= 2; left -= 2) {
        const bool horizontal = spec.width / sides.horizontal >= spec.height / sides.vertical;
        ++(horizontal ? sides.horizontal : sides.vertical);
    }
    sides.one_more_at_bottom = left == 1;
    return sides;
}

// Reckoned from the nearer corner: stays on the side, and mirror images match to the bit.
void append_side(Points& points, const Vec2& from, const Vec2& to, int pieces) {
    for (int k = 0; k < pieces; ++k) {
        points.emplace_back(2 * k <= pieces ? from + (to - from) * k / pieces
                                            : to + (from - to) * (pieces - k) / pieces);
    }
}

Points outline_points(const std::string& name, const RectangleSpec& spec) {
    check_length(name, "width", spec.width);
    check_length(name, "height", spec.height);
    check_count(name, "vertices", spec.vertices, 4);
    const SideCounts sides = share_out(spec);
    const double x = 0.5 * spec.width;
    const double y = 0.5 * spec.height;
    Points points;
    append_side(points, {-x, -y}, {x, -y}, sides.horizontal + (sides.one_more_at_bottom ? 1 : 0));
    append_side(points, {x, -y}, {x, y}, sides.vertical);
    append_side(points, {x, y}, {-x, y}, sides.horizontal);
    append_side(points, {-x, y}, {-x, -y}, sides.vertical);
    return points;
}

Points outline_points(const std::string& name, const RegularSpec& spec) {
    check_length(name, "radius", spec.radius);
    check_count(name, "sides", spec.sides, 3);
    Points points;
    for (int k = 0; k < spec.sides; ++k) points.emplace_back(spec.radius * part_of_turn(k, spec.sides));
    return points;
}

// Equal steps of the polar angle on the shape of width and height 2, then stretched: exponent 2 gives the usual
// parameter of an ellipse, and large exponents do not crowd their vertices at the corners.
Points superellipse_points(const std::string& name, const SuperellipseSpec& spec) {
    constexpr double k_least_exponent = 0.2, k_most_exponent = 100.0;
    check_length(name, "width", spec.width);
    check_length(name, "height", spec.height);
    check_count(name, "vertices", spec.vertices, 3);
    require(spec.exponent >= k_least_exponent && spec.exponent <= k_most_exponent,
            "shape \"{}\": exponent is {}: give a number from {} to {} (2 is an ellipse, more is boxier)", name,
            spec.exponent, k_least_exponent, k_most_exponent);
    const auto term = [&](double value) { return value == 0.0 ? 0.0 : power(std::abs(value), spec.exponent); };
    Points points;
    for (int k = 0; k < spec.vertices; ++k) {
        const Vec2 direction = part_of_turn(k, spec.vertices);
        const double radius =
            spec.exponent == 2.0 ? 1.0 : power(term(direction.x()) + term(direction.y()), -1.0 / spec.exponent);
        points.emplace_back(0.5 * spec.width * radius * direction.x(), 0.5 * spec.height * radius * direction.y());
    }
    return points;
}

Points outline_points(const std::string& name, const EllipseSpec& spec) {
    return superellipse_points(name, {spec.width, spec.height, 2.0, spec.vertices});
}

Points outline_points(const std::string& name, const SuperellipseSpec& spec) { return superellipse_points(name, spec); }

Points outline_points(const std::string& name, const StickSpec& spec) {
    check_length(name, "length", spec.length);
    check_length(name, "width", spec.width);
    require(spec.length > spec.width,
            "shape \"{}\": length {} is not above width {}: make the stick longer, or take a disk", name, spec.length,
            spec.width);
    check_count(name, "vertices", spec.vertices, 6);
    require(spec.vertices % 2 == 0, "shape \"{}\": vertices is {}: give an even number, half for each end", name,
            spec.vertices);
    const int per_end = spec.vertices / 2;
    const double radius = 0.5 * spec.width;
    const Vec2 end{0.5 * (spec.length - spec.width), 0.0};
    Points points;
    for (int k = 0; k < per_end; ++k) {
        points.emplace_back(end + radius * right_normal(part_of_turn(k, 2 * (per_end - 1))));
    }
    for (int k = 0; k < per_end; ++k) points.emplace_back(-points[static_cast<std::size_t>(k)]);
    return points;
}

Points outline_points(const std::string& name, const StarSpec& spec) {
    check_length(name, "radius", spec.radius);
    check_length(name, "inner_radius", spec.inner_radius);
    require(spec.inner_radius < spec.radius,
            "shape \"{}\": inner_radius {} is not below radius {}: it is the distance of the notches from the centre",
            name, spec.inner_radius, spec.radius);
    check_count(name, "points", spec.points, 3, PolarPolygon::k_max_vertices / 2);
    Points points;
    for (int k = 0; k < 2 * spec.points; ++k) {
        points.emplace_back((k % 2 == 0 ? spec.radius : spec.inner_radius) * part_of_turn(k, 2 * spec.points));
    }
    return points;
}

Points outline_points(const std::string& name, const PolarSpec& spec) {
    const auto& vertices = spec.vertices;
    require(vertices.size() >= 3, "shape \"{}\" has {} vertices: give at least 3", name, vertices.size());
    Points points;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const auto [radius, angle] = vertices[k];
        const double angle_before = vertices[k == 0 ? 0 : k - 1].second;
        require(std::isfinite(radius) && radius > 0.0,
                "shape \"{}\": the radius of vertex {} is {}: give a finite length above 0 [m]", name, k, radius);
        require(std::isfinite(angle), "shape \"{}\": the angle of vertex {} is {}: give a finite number", name, k,
                angle);
        require(k == 0 || angle > angle_before,
                "shape \"{}\": vertex {} is at {} degrees, not beyond the vertex before it at {}: angles must rise",
                name, k, angle / k_radians_per_degree, angle_before / k_radians_per_degree);
        require(angle - vertices[0].second < 2.0 * k_pi,
                "shape \"{}\": vertex {} is at {} degrees, a full turn or more beyond vertex 0: stay within one turn",
                name, k, angle / k_radians_per_degree);
        points.push_back(at_angle(radius, angle));
    }
    return points;
}

Points outline_points(const std::string&, const OutlineSpec& spec) { return spec.points; }

void check(const std::string& name, const RoughSpec& spec) {
    check_length(name, "radius", spec.radius);
    require(spec.roughness >= 0.0 && spec.roughness < 1.0, "shape \"{}\": roughness is {}: give a number in [0, 1)",
            name, spec.roughness);
    check_count(name, "vertices", spec.vertices, 3);
    require(spec.first_mode >= 1 && spec.first_mode <= spec.last_mode,
            "shape \"{}\": modes run from {} to {}: give two rising whole numbers above 0, such as 2 and 6", name,
            spec.first_mode, spec.last_mode);
    require(spec.first_mode <= spec.vertices / 2,
            "shape \"{}\": {} vertices cannot show mode {}: give twice as many vertices as the lowest mode, or more",
            name, spec.vertices, spec.first_mode);
}

Points rough_points(const RoughSpec& spec, RandomStream random) {
    const int last_mode = std::min(spec.last_mode, spec.vertices / 2);
    // 2 M coefficients of variance 1 / (2 M): the series has variance 1/2.
    const double deviation = std::sqrt(0.5 / (last_mode - spec.first_mode + 1));
    std::vector<Vec2> terms;  // amplitudes of cosine and sine
    for (int mode = spec.first_mode; mode <= last_mode; ++mode) {
        const double cosine = deviation * random.normal();
        terms.emplace_back(cosine, deviation * random.normal());
    }
    Points points;
    for (int k = 0; k < spec.vertices; ++k) {
        double series = 0.0;
        for (std::size_t m = 0; m < terms.size(); ++m) {
            const Vec2 phase = part_of_turn((spec.first_mode + static_cast<std::int64_t>(m)) * k, spec.vertices);
            series += terms[m].dot(phase);
        }
        const double radius = spec.radius * (1.0 + spec.roughness * std::clamp(series, -1.0, 1.0));
        points.emplace_back(radius * part_of_turn(k, spec.vertices));
    }
    return points;
}

Shape make(const std::string& name, const RoughSpec& spec, std::uint64_t seed, std::uint64_t draw) {
    constexpr std::uint32_t k_attempts = 100;
    check(name, spec);
    for (std::uint32_t attempt = 0; attempt < k_attempts; ++attempt) {
        const RandomStream random(seed, RandomPurpose::rough_shape, spec.same ? 0 : draw, attempt);
        if (auto polygon = try_prepare_outline(name, rough_points(spec, random))) return *std::move(polygon);
    }
    throw InputError(fmt::format(
        "shape \"{}\": none of {} draws is star-shaped about its centre of mass: lower roughness ({}) or modes", name,
        k_attempts, spec.roughness));
}

Shape make(const std::string& name, const DiskSpec& spec, std::uint64_t /*seed*/, std::uint64_t /*draw*/) {
    return Disk(name, spec.radius);
}

template <typename Spec>
Shape make(const std::string& name, const Spec& spec, std::uint64_t /*seed*/, std::uint64_t /*draw*/) {
    return prepare_outline(name, outline_points(name, spec));
}

}  // namespace

Shape make_shape(const std::string& name, const ShapeSpec& spec, std::uint64_t seed, std::uint64_t draw) {
    return std::visit([&](const auto& s) { return make(name, s, seed, draw); }, spec);
}

bool differs_by_grain(const ShapeSpec& spec) {
    const auto* rough = std::get_if<RoughSpec>(&spec);
    return rough != nullptr && !rough->same;
}

}  // namespace polargrain
