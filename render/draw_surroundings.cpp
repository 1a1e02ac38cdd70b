#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/painting.h"
#include "render/round_number.h"
#include "src/core/elementary.h"

namespace polargrain {

namespace {

/// How the legend names the quantity, and what it divides SI values by.
struct Quantity {
    std::string label;
    double factor = 1.0;
};

Quantity with_unit(const char* name, const char* unit, double largest) {
    const ScaledUnit scaled = scaled_unit(largest, unit);
    return {fmt::format("{} [{}]", name, scaled.unit), scaled.factor};
}

Quantity quantity_of(const FrameStyle& style) {
    switch (style.colour) {
        case ColourBy::speed: return with_unit("speed", "m/s", style.colour_max);
        case ColourBy::spin: return {"spin [rad/s]", 1.0};
        case ColourBy::angle: return {"angle [\u00b0]", k_radians_per_degree};
        case ColourBy::kinetic_energy: return with_unit("kinetic energy [per depth]", "J/m", style.colour_max);
        case ColourBy::size: return with_unit("outer radius", "m", style.colour_max);
        case ColourBy::contacts: return {"contacts of a grain", 1.0};
        case ColourBy::id:
        case ColourBy::shape:
        case ColourBy::material:
        case ColourBy::force:
        case ColourBy::none: break;
    }
    return {};
}

std::vector<double> ticks_of(const FrameStyle& style, const Quantity& quantity) {
    if (style.colour == ColourBy::angle) return {0.0, 90.0, 180.0, 270.0, 360.0};
    return ticks(style.colour_min / quantity.factor, style.colour_max / quantity.factor, 6);
}

void fill_with_scale(cairo_t* cr, const Rect& bar, std::span<const Colour> anchors) {
    cairo_pattern_t* scale = cairo_pattern_create_linear(bar.x, 0.0, bar.right(), 0.0);
    for (std::size_t k = 0; k < anchors.size(); ++k) {
        const Colour& c = anchors[k];
        const double place = static_cast<double>(k) / static_cast<double>(anchors.size() - 1);
        cairo_pattern_add_color_stop_rgb(scale, place, c.r, c.g, c.b);
    }
    cairo_set_source(cr, scale);
    cairo_pattern_destroy(scale);
    cairo_fill_preserve(cr);
}

/// The bar, pointed at the ends beyond which values may lie.
void trace_bar(cairo_t* cr, const Rect& bar, bool pointed_left, bool pointed_right) {
    const double point = 0.7 * bar.height;
    cairo_move_to(cr, bar.x, bar.y);
    cairo_line_to(cr, bar.right(), bar.y);
    if (pointed_right) cairo_line_to(cr, bar.right() + point, bar.centre_y());
    cairo_line_to(cr, bar.right(), bar.bottom());
    cairo_line_to(cr, bar.x, bar.bottom());
    if (pointed_left) cairo_line_to(cr, bar.x - point, bar.centre_y());
    cairo_close_path(cr);
}

void draw_colour_bar(cairo_t* cr, const Rect& footer, double letter, const FrameStyle& style) {
    const Quantity quantity = quantity_of(style);
    const double width = std::min(17.0 * letter, 0.45 * footer.width);
    const Rect bar{footer.right() - 1.2 * letter - width, footer.y + 0.65 * letter, width, 0.75 * letter};
    const bool open_above = style.colour == ColourBy::speed || style.colour == ColourBy::kinetic_energy ||
                            style.colour == ColourBy::spin || style.colour == ColourBy::contacts;
    trace_bar(cr, bar, style.colour == ColourBy::spin, open_above);
    fill_with_scale(cr, bar, colour_anchors(style.colour));
    set_colour(cr, k_ink);
    cairo_set_line_width(cr, 0.05 * letter);
    cairo_stroke(cr);

    choose_font(cr, 0.8 * letter);
    const double low = style.colour_min / quantity.factor;
    const double high = style.colour_max / quantity.factor;
    for (const double tick : ticks_of(style, quantity)) {
        const double x = bar.x + bar.width * (tick - low) / (high - low);
        cairo_move_to(cr, x, bar.bottom());
        cairo_line_to(cr, x, bar.bottom() + 0.25 * letter);
        cairo_stroke(cr);
        draw_text(cr, x, bar.bottom() + 1.15 * letter, fmt::format("{:.6g}", tick), Align::centre);
    }
    choose_font(cr, 0.9 * letter);
    draw_text(cr, bar.x - 1.1 * letter, bar.bottom() - 0.08 * letter, quantity.label, Align::right);
}

void draw_key(cairo_t* cr, const Rect& footer, double letter, const std::vector<std::string>& names) {
    choose_font(cr, 0.9 * letter);
    const double side = 0.8 * letter;
    double right = footer.right();
    // From the right, so that the last stands at the margin; what would run into the scale bar is left out.
    for (int m = static_cast<int>(names.size()) - 1; m >= 0; --m) {
        const double width = text_width(cr, names[static_cast<std::size_t>(m)]);
        const double left = right - width - 1.4 * side;
        if (left < footer.x + 0.35 * footer.width) return;
        set_colour(cr, k_ink);
        draw_text(cr, right, footer.y + 1.35 * letter, names[static_cast<std::size_t>(m)], Align::right);
        cairo_rectangle(cr, left, footer.y + 0.65 * letter, side, side);
        set_colour(cr, category_colour(m));
        cairo_fill_preserve(cr);
        set_colour(cr, k_ink);
        cairo_set_line_width(cr, 0.05 * letter);
        cairo_stroke(cr);
        right = left - letter;
    }
}

std::vector<std::string> material_names(const Materials& materials) {
    std::vector<std::string> names;
    for (MaterialIndex m = 0; m < materials.size(); ++m) names.push_back(materials[m].name);
    return names;
}

/// Lines of the force chains with what they stand for: the full thickness, and a quarter of it.
void draw_chain_key(cairo_t* cr, const Rect& footer, double letter, const FrameStyle& style, double scale) {
    const bool forces = style.time_step > 0.0;
    const double full = forces ? style.chain_scale / style.time_step : style.chain_scale;
    const ScaledUnit unit = scaled_unit(full, forces ? "N/m" : "N s/m");
    double right = footer.right();
    for (const double part : {1.0, 0.25}) {
        choose_font(cr, 0.9 * letter);
        const std::string text =
            fmt::format("{:.3g} {}{}", part * full / unit.factor, unit.unit, part == 1.0 ? " or more" : "");
        set_colour(cr, k_ink);
        draw_text(cr, right, footer.y + 1.35 * letter, text, Align::right);
        const double left = right - text_width(cr, text) - 3.0 * letter;
        cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
        cairo_set_line_width(cr, chain_thickness(style, part * style.chain_scale, scale));
        set_colour(cr, k_chain_ink);
        cairo_move_to(cr, left, footer.y + 1.0 * letter);
        cairo_line_to(cr, left + 2.3 * letter, footer.y + 1.0 * letter);
        cairo_stroke(cr);
        right = left - letter;
    }
    set_colour(cr, k_ink);
    draw_text(cr, right, footer.y + 1.35 * letter, forces ? "contact force" : "contact impulse", Align::right);
}

}  // namespace

void draw_header(cairo_t* cr, const Rect& header, double letter, const std::string& title,
                 const std::optional<std::string>& time) {
    const Saved saved(cr);
    set_colour(cr, k_ink);
    const double base = header.bottom() - 0.75 * letter;
    double room = header.width;
    choose_font(cr, letter);
    if (time) {
        draw_text(cr, header.right(), base, *time, Align::right);
        room -= text_width(cr, *time) + 2.0 * letter;
    }
    choose_font(cr, letter, true);
    draw_text(cr, header.x, base, fitted(cr, title, room), Align::left);
}

void draw_legend(cairo_t* cr, const Rect& footer, double letter, const FrameStyle& style, const Scene& scene,
                 double scale) {
    const Saved saved(cr);
    switch (style.colour) {
        case ColourBy::none:
        case ColourBy::id: return;
        case ColourBy::material: draw_key(cr, footer, letter, material_names(scene.materials)); return;
        case ColourBy::shape: draw_key(cr, footer, letter, shape_kinds(scene)); return;
        case ColourBy::force: draw_chain_key(cr, footer, letter, style, scale); return;
        default: draw_colour_bar(cr, footer, letter, style);
    }
}

void draw_scale_bar(cairo_t* cr, const Rect& footer, double letter, double scale) {
    const Saved saved(cr);
    const double length = round_down(std::min(0.25 * footer.width, 12.0 * letter) / scale);
    const double width = length * scale;
    const double y = footer.y + 1.0 * letter;
    set_colour(cr, k_ink);
    cairo_set_line_width(cr, 0.14 * letter);
    cairo_move_to(cr, footer.x, y);
    cairo_line_to(cr, footer.x + width, y);
    for (const double x : {footer.x, footer.x + width}) {
        cairo_move_to(cr, x, y - 0.3 * letter);
        cairo_line_to(cr, x, y + 0.3 * letter);
    }
    cairo_stroke(cr);
    choose_font(cr, 0.9 * letter);
    draw_text(cr, footer.x + 0.5 * width, y + 1.35 * letter, length_text(length), Align::centre);
}

}  // namespace polargrain
