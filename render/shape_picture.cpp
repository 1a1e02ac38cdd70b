#include "render/shape_picture.h"

#include <fmt/format.h>

#include <array>

#include "render/layout.h"
#include "render/painting.h"
#include "src/core/elementary.h"

namespace polargrain {

namespace {

constexpr int k_most_numbers = 40;
constexpr Colour k_outer{0.80, 0.20, 0.16};
constexpr Colour k_inner{0.05, 0.45, 0.35};
constexpr std::array<Colour, 2> k_sectors = {{{0.80, 0.87, 0.93}, {0.90, 0.94, 0.97}}};

int vertex_count(const Shape& shape) {
    const auto* polygon = std::get_if<PolarPolygon>(&shape);
    return polygon != nullptr ? polygon->size() : 0;
}

void draw_sectors(cairo_t* cr, const PolarPolygon& polygon, const Projection& to_paper, double letter) {
    const Vec2 centre = to_paper(Vec2::Zero());
    for (int q = 0; q < polygon.size(); ++q) {
        const Vec2 a = to_paper(polygon.vertex(q)), b = to_paper(polygon.vertex(polygon.next(q)));
        cairo_move_to(cr, centre.x(), centre.y());
        cairo_line_to(cr, a.x(), a.y());
        cairo_line_to(cr, b.x(), b.y());
        cairo_close_path(cr);
        set_colour(cr, k_sectors[static_cast<std::size_t>(q) % 2]);
        cairo_fill(cr);
    }
    set_colour(cr, {0.45, 0.55, 0.65}, 0.8);
    cairo_set_line_width(cr, 0.05 * letter);
    for (int q = 0; q < polygon.size(); ++q) {
        const Vec2 a = to_paper(polygon.vertex(q));
        cairo_move_to(cr, centre.x(), centre.y());
        cairo_line_to(cr, a.x(), a.y());
    }
    cairo_stroke(cr);
}

void draw_vertices(cairo_t* cr, const PolarPolygon& polygon, const Projection& to_paper, double letter) {
    set_colour(cr, k_ink);
    choose_font(cr, 0.7 * letter);
    for (int q = 0; q < polygon.size(); ++q) {
        const Vec2 p = to_paper(polygon.vertex(q));
        cairo_arc(cr, p.x(), p.y(), 0.16 * letter, 0.0, 2.0 * k_pi);
        cairo_fill(cr);
        if (polygon.size() > k_most_numbers) continue;
        const Vec2 outwards = unit(p - to_paper(Vec2::Zero()));
        const Vec2 at = p + 0.75 * letter * outwards;
        draw_text(cr, at.x(), at.y() + 0.25 * letter, fmt::format("{}", q), Align::centre);
    }
}

void draw_circle(cairo_t* cr, const Projection& to_paper, double radius, const Colour& colour, double letter) {
    const Saved saved(cr);
    const Vec2 centre = to_paper(Vec2::Zero());
    const std::array<double, 2> dashes = {0.5 * letter, 0.3 * letter};
    cairo_set_dash(cr, dashes.data(), 2, 0.0);
    cairo_set_line_width(cr, 0.08 * letter);
    set_colour(cr, colour);
    cairo_arc(cr, centre.x(), centre.y(), radius * to_paper.scale(), 0.0, 2.0 * k_pi);
    cairo_stroke(cr);
}

/// The usual sign for a centre of mass: a circle with two black quarters.
void draw_centre(cairo_t* cr, const Projection& to_paper, double letter) {
    const Vec2 centre = to_paper(Vec2::Zero());
    const double radius = 0.35 * letter;
    cairo_arc(cr, centre.x(), centre.y(), radius, 0.0, 2.0 * k_pi);
    cairo_set_source_rgb(cr, 1.0, 1.0, 1.0);
    cairo_fill_preserve(cr);
    set_colour(cr, k_ink);
    cairo_set_line_width(cr, 0.07 * letter);
    cairo_stroke(cr);
    for (const double start : {0.0, k_pi}) {
        cairo_move_to(cr, centre.x(), centre.y());
        cairo_arc(cr, centre.x(), centre.y(), radius, start, start + 0.5 * k_pi);
        cairo_close_path(cr);
        cairo_fill(cr);
    }
}

void draw_outline(cairo_t* cr, const Shape& shape, const Projection& to_paper, double letter) {
    const auto* polygon = std::get_if<PolarPolygon>(&shape);
    if (polygon != nullptr) draw_sectors(cr, *polygon, to_paper, letter);
    trace(cr, shape, {}, to_paper);
    if (polygon == nullptr) {
        set_colour(cr, k_sectors[0]);
        cairo_fill_preserve(cr);
    }
    set_colour(cr, k_ink);
    cairo_set_line_width(cr, 0.14 * letter);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cr);
    draw_circle(cr, to_paper, outer_radius(shape), k_outer, letter);
    if (polygon != nullptr) {
        draw_circle(cr, to_paper, inner_radius(shape), k_inner, letter);
        draw_vertices(cr, *polygon, to_paper, letter);
    }
    draw_centre(cr, to_paper, letter);
}

/// A dash in the circle's colour and what it stands for.
void draw_key(cairo_t* cr, double x, double y, double letter, const Colour& colour, const char* text) {
    set_colour(cr, colour);
    cairo_set_line_width(cr, 0.12 * letter);
    cairo_move_to(cr, x, y - 0.3 * letter);
    cairo_line_to(cr, x + 1.6 * letter, y - 0.3 * letter);
    cairo_stroke(cr);
    set_colour(cr, k_ink);
    draw_text(cr, x + 2.1 * letter, y, text, Align::left);
}

void draw_column(cairo_t* cr, const Rect& column, double letter, const Shape& shape,
                 const std::vector<std::string>& properties) {
    set_colour(cr, k_ink);
    choose_font(cr, 1.2 * letter, true);
    double y = column.y + 2.0 * letter;
    draw_text(cr, column.x, y, fitted(cr, name(shape), column.width), Align::left);
    choose_font(cr, 0.8 * letter);
    y += 0.6 * letter;
    for (const std::string& line : properties) {
        y += 1.5 * letter;
        draw_text(cr, column.x, y, fitted(cr, line, column.width), Align::left);
    }
    y += 2.2 * letter;
    draw_key(cr, column.x, y, letter, k_outer, "outer radius");
    if (std::holds_alternative<PolarPolygon>(shape)) {
        draw_key(cr, column.x, y + 1.5 * letter, letter, k_inner, "inner radius");
    }
}

}  // namespace

void draw_shape(const Shape& shape, const std::vector<std::string>& properties, const std::filesystem::path& path,
                int width) {
    const int side = width * 7 / 20 * 2;
    Canvas canvas(path, width, side);
    cairo_t* cr = canvas.context();
    const double letter = letter_height(1.2 * width);
    const double reach = 1.16 * outer_radius(shape);
    const Rect square{0.0, 0.0, static_cast<double>(side), static_cast<double>(side)};
    const Projection to_paper({Vec2(-reach, -reach), Vec2(reach, reach)}, square);
    draw_outline(cr, shape, to_paper, letter);
    const Rect column{square.right() + 0.3 * letter, 0.0, width - square.right() - letter, square.height};
    draw_column(cr, column, letter, shape, properties);
    draw_scale_bar(cr, {column.x, square.bottom() - 3.4 * letter, column.width * 2.0, 3.0 * letter}, letter,
                   to_paper.scale());
    canvas.finish();
}

std::vector<std::string> describe_shape(const Shape& shape) {
    std::vector<std::string> lines = {fmt::format("area {:.4g} m\u00b2", area(shape)),
                                      fmt::format("polar moment {:.4g} m\u2074", polar_moment(shape)),
                                      fmt::format("outer radius {:.4g} m", outer_radius(shape)),
                                      fmt::format("inner radius {:.4g} m", inner_radius(shape))};
    const int vertices = vertex_count(shape);
    lines.push_back(vertices > 0 ? fmt::format("{} vertices", vertices) : std::string("a true circle"));
    return lines;
}

}  // namespace polargrain
