#include "src/reproduce/shape_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shapes/outline.h"
#include "shapes/shape_spec.h"
#include "src/core/random.h"
#include "src/reproduce/sketch.h"

namespace polargrain {

namespace {

/// A rough non-convex grain with the paper's usual number of vertices.
Shape sample_grain() { return make_shape("grain", RoughSpec{.radius = 0.01, .roughness = 0.2, .vertices = 24}, 3); }

Finding exactly(const std::string& quantity, double measured, double expected, double tolerance,
                const std::string& against) {
    return {"", quantity, measured, expected - tolerance, expected + tolerance, "", against, ""};
}

/// The paper's test by areas: p lies in the sector's triangle where the triangles iAp and ipB together are smaller than
/// iAB. [HN94, sec. 3.4.1, Fig. 5]
bool inside_by_areas(const PolarPolygon& grain, const Vec2& p) {
    const int q = grain.sector_of(p);
    const Vec2 a = grain.vertex(q), b = grain.vertex(grain.next(q));
    return 0.5 * (cross(a, p) + cross(p, b)) < 0.5 * cross(a, b);
}

/// Even-odd rule over all edges: knows nothing of sectors.
bool inside_by_crossings(const PolarPolygon& grain, const Vec2& p) {
    bool inside = false;
    for (int q = 0; q < grain.size(); ++q) {
        const Vec2 a = grain.vertex(q), b = grain.vertex(grain.next(q));
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
}

struct PointCount {
    int all = 0, inside = 0, areas_differ = 0, depth_differs = 0;
};

PointCount count_points(const PolarPolygon& grain) {
    RandomStream random(1, RandomPurpose::test);
    PointCount count;
    const double r = 1.2 * grain.outer_radius();
    for (; count.all < 200000; ++count.all) {
        const Vec2 p{random.uniform(-r, r), random.uniform(-r, r)};
        const bool inside = inside_by_crossings(grain, p);
        count.inside += inside;
        count.areas_differ += inside_by_areas(grain, p) != inside;
        count.depth_differs += (grain.depth(p) > 0.0) != inside;
    }
    return count;
}

}  // namespace

FigureResult draw_fig2(const FigureDesk& desk) {
    const Shape shape = sample_grain();
    const auto& grain = std::get<PolarPolygon>(shape);
    Panel map{.title = "outline and radii", .map = true};
    map.series.push_back(sketch_shape(shape, {}, SeriesStyle::filled, 0));
    Panel polar{.title = "the array (θ, R) that represents it", .x_label = "θ [rad]", .y_label = "R [mm]"};
    Series array{.style = SeriesStyle::line_points};
    double area = 0.0, moment = 0.0, round_trip = 0.0;
    for (int q = 0; q < grain.size(); ++q) {
        const Vec2 v = grain.vertex(q);
        map.series.push_back({.x = {0.0, v.x()}, .y = {0.0, v.y()}, .colour = 5, .width = 1.0});
        const auto [r, theta] = grain.polar_vertex(q);
        const auto [r1, theta1] = grain.polar_vertex(grain.next(q));
        const Vec2 a{r * std::cos(theta), r * std::sin(theta)}, b{r1 * std::cos(theta1), r1 * std::sin(theta1)};
        area += 0.5 * cross(a, b);
        moment += cross(a, b) * (a.dot(a) + a.dot(b) + b.dot(b)) / 12.0;
        round_trip = std::fmax(round_trip, std::sqrt((a - v).squaredNorm()));
        array.x.push_back(theta < 0.0 ? theta + 2.0 * k_pi : theta);
        array.y.push_back(1e3 * r);
    }
    polar.series.push_back(array);
    write_plot({"Fig. 2: a particle in polar form", {map, polar}, 2, 1300, 560}, desk.stem("fig2"));
    FigureResult result;
    result.paragraphs = {fmt::format(
        "A rough grain of {} vertices. Each is kept as its distance R from the centre of mass and its angle θ, and the "
        "grain may be non-convex as long as every vertex is seen from the centre of mass. Radii run from {:.2f} to "
        "{:.2f} mm; every point nearer to the centre than {:.2f} mm is inside.",
        grain.size(), *std::min_element(array.y.begin(), array.y.end()), 1e3 * grain.outer_radius(),
        1e3 * grain.inner_radius())};
    result.pictures = {{desk.stem("fig2"), "The outline with its radii, and the array that represents it"}};
    result.findings = {
        exactly("area from the polar array over the exact area", area / grain.area(), 1.0, 1e-12, "exact arithmetic"),
        exactly("polar moment from the array over the exact one", moment / grain.polar_moment(), 1.0, 1e-12,
                "exact arithmetic"),
        exactly("largest error of a vertex after (R, θ) and back, over R_max", round_trip / grain.outer_radius(), 0.0,
                1e-14, "the same point")};
    return result;
}

FigureResult draw_fig5(const FigureDesk& desk) {
    const Shape shape = sample_grain();
    const auto& grain = std::get<PolarPolygon>(shape);
    const Shape visitor = make_shape("visitor", RoughSpec{.radius = 0.008, .roughness = 0.2, .vertices = 24}, 5);
    const Pose pose = Pose::at({0.0151, 0.0062}, 0.4);
    // The vertex of the visitor that lies deepest in the grain.
    Vec2 p = Vec2::Zero();
    double depth = 0.0;
    for (const Vec2& v : std::get<PolarPolygon>(visitor).vertices()) {
        const Vec2 at = pose.to_world(v);
        if (grain.depth(at) > depth) {
            depth = grain.depth(at);
            p = at;
        }
    }
    const int q = grain.sector_of(p);
    const Vec2 a = grain.vertex(q), b = grain.vertex(grain.next(q));
    const auto triangle = [](const Vec2& u, const Vec2& v, const Vec2& w, int colour) {
        return Series{
            .style = SeriesStyle::filled, .x = {u.x(), v.x(), w.x()}, .y = {u.y(), v.y(), w.y()}, .colour = colour};
    };
    const Vec2 i = Vec2::Zero();
    Panel contact{.title = "(a) vertex p of one grain in another", .map = true};
    contact.series = {sketch_shape(shape, {}, SeriesStyle::filled, 0),
                      sketch_shape(visitor, pose, SeriesStyle::filled, 1),
                      sketch_point(p, 6),
                      sketch_text(p + Vec2(-0.0006, 0.0008), "p"),
                      sketch_text({0.0, -0.0007}, "i"),
                      sketch_point(i, 6)};
    Panel areas{.title = "(b) the sector that holds p: iAp and ipB together are smaller than iAB", .map = true};
    const Vec2 middle = (a + b) / 3.0;
    areas.series = {triangle(i, a, b, 4),
                    triangle(i, a, p, 2),
                    triangle(i, p, b, 5),
                    sketch_point(p, 6),
                    sketch_text(a * 1.06, "A"),
                    sketch_text(b * 1.06, "B"),
                    sketch_text(i - 0.08 * middle, "i"),
                    sketch_text(p + 0.06 * unit(p) * grain.outer_radius() * 0.5, "p")};
    write_plot({"Fig. 5: is the vertex inside?", {contact, areas}, 2, 1300, 560}, desk.stem("fig5"));
    const PointCount count = count_points(grain);
    FigureResult result;
    result.paragraphs = {fmt::format(
        "The direction of p tells its sector, and two triangles are compared with a third. The program asks for the "
        "depth "
        "behind the sector's edge instead, which has the same sign and is a length besides. Both were held to the "
        "even-odd rule over all edges, for {} random points, of which {} lie inside.",
        count.all, count.inside)};
    result.pictures = {{desk.stem("fig5"), "The contact and the triangles of the test, drawn from the code that runs"}};
    result.findings = {
        exactly("points that the test by areas puts on the wrong side", count.areas_differ, 0.0, 0.0, "even-odd rule"),
        exactly("points that the test by depth puts on the wrong side", count.depth_differs, 0.0, 0.0,
                "even-odd rule")};
    return result;
}

}  // namespace polargrain
