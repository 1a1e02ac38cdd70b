#include "render/side_by_side.h"

#include <algorithm>
#include <cmath>

#include "render/layout.h"
#include "render/painting.h"

namespace polargrain {

namespace {

constexpr double k_widest_sheet = 1920.0;
constexpr double k_widest_cell = 900.0;
constexpr double k_highest_sheet = 1600.0;

double aspect_of(const View& view) { return std::clamp(view.height() / view.width(), 0.05, 3.0); }

int columns_for(const View& view, int count) { return aspect_of(view) < 0.5 ? 1 : count; }

int even(double pixels) { return 2 * static_cast<int>(std::ceil(0.5 * pixels)); }

/// Margins, in heights of letters.
constexpr double k_side = 1.0, k_header = 2.3, k_name = 1.7, k_gap = 0.8, k_footer = 3.2;

double chrome(int rows, double letter) { return (k_header + k_footer + rows * (k_name + k_gap)) * letter; }

}  // namespace

FrameStyle side_by_side_style(FrameStyle one, int count) {
    const int columns = columns_for(one.view, count);
    const int rows = (count + columns - 1) / columns;
    double width = columns == 1 ? 1280.0 : std::min(k_widest_sheet, columns * k_widest_cell);
    const auto height = [&](double w) {
        const double letter = letter_height(0.7 * w);
        const double cell = (w - 2.0 * k_side * letter - (columns - 1) * k_gap * letter) / columns;
        return rows * cell * aspect_of(one.view) + chrome(rows, letter);
    };
    width *= std::min(1.0, k_highest_sheet / height(width));
    one.width = even(width);
    one.height = even(height(one.width));
    return one;
}

void paint_side_by_side(cairo_t* cr, const Rect& sheet, std::span<const NamedPicture> pictures,
                        const FrameStyle& style) {
    const double letter = letter_height(0.7 * sheet.width);
    const auto count = static_cast<int>(pictures.size());
    const int columns = columns_for(style.view, count);
    const int rows = (count + columns - 1) / columns;
    const double inner = sheet.width - 2.0 * k_side * letter;
    const double cell_width = (inner - (columns - 1) * k_gap * letter) / columns;
    const double cell_height = (sheet.height - chrome(rows, letter)) / rows;
    draw_header(cr, {k_side * letter, 0.0, inner, k_header * letter}, letter, style.title,
                time_text(pictures.front().picture.time, style.time_decimals));
    double scale = 1.0;
    for (int k = 0; k < count; ++k) {
        const NamedPicture& each = pictures[static_cast<std::size_t>(k)];
        const int row = k / columns;
        const double x = k_side * letter + (k % columns) * (cell_width + k_gap * letter);
        const double y = k_header * letter + row * (cell_height + (k_name + k_gap) * letter);
        choose_font(cr, 0.95 * letter);
        set_colour(cr, k_ink);
        draw_text(cr, x, y + 1.15 * letter, fitted(cr, each.name, cell_width), Align::left);
        const Rect cell{x, y + k_name * letter, cell_width, cell_height};
        draw_plot(cr, each.picture, style, cell, letter);
        scale = Projection(style.view, cell).scale();
    }
    const Rect footer{k_side * letter, sheet.height - k_footer * letter, inner, k_footer * letter};
    draw_legend(cr, footer, letter, style, pictures.front().picture.scene, scale);
    draw_scale_bar(cr, footer, letter, scale);
}

void draw_side_by_side(std::span<const NamedPicture> pictures, const FrameStyle& style,
                       const std::filesystem::path& path) {
    Canvas canvas(path, style.width, style.height);
    paint_side_by_side(canvas.context(), canvas.sheet(), pictures, style);
    canvas.finish();
}

}  // namespace polargrain
