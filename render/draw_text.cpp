#include <fmt/format.h>

#include "render/painting.h"

namespace polargrain {

void set_colour(cairo_t* cr, const Colour& colour, double opacity) {
    cairo_set_source_rgba(cr, colour.r, colour.g, colour.b, opacity);
}

void choose_font(cairo_t* cr, double size, bool bold) {
    cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
}

double text_width(cairo_t* cr, const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cr, text.c_str(), &extents);
    return extents.x_advance;
}

void draw_text(cairo_t* cr, double x, double y, const std::string& text, Align align) {
    const double part = align == Align::left ? 0.0 : align == Align::centre ? 0.5 : 1.0;
    cairo_move_to(cr, x - part * text_width(cr, text), y);
    cairo_show_text(cr, text.c_str());
    cairo_new_path(cr);  // what is drawn next must not be joined to the end of the text
}

std::string fitted(cairo_t* cr, const std::string& text, double width) {
    if (text_width(cr, text) <= width) return text;
    std::string shorter = text;
    const auto continues_letter = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    while (!shorter.empty()) {
        while (continues_letter(shorter.back())) shorter.pop_back();
        shorter.pop_back();
        const std::string candidate = shorter + "\u2026";
        if (text_width(cr, candidate) <= width) return candidate;
    }
    return {};
}

std::string time_text(double time, int decimals) { return fmt::format("t = {:.{}f} s", time, decimals); }

}  // namespace polargrain
