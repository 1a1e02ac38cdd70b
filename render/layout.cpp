#include "render/layout.h"

#include <algorithm>

#include "render/painting.h"

namespace polargrain {

namespace {

// In heights of letters.
constexpr double k_side = 1.0;
constexpr double k_header = 2.3;
constexpr double k_footer = 3.2;

}  // namespace

double letter_height(double width) { return std::clamp(width / 64.0, 7.0, 40.0); }

double height_for(double width, double aspect) {
    const double letter = letter_height(width);
    return aspect * (width - 2.0 * k_side * letter) + (k_header + k_footer) * letter;
}

FrameLayout frame_layout(const Rect& sheet) {
    const double letter = letter_height(sheet.width);
    FrameLayout layout{};
    layout.letter = letter;
    const double x = sheet.x + k_side * letter;
    const double width = sheet.width - 2.0 * k_side * letter;
    layout.header = {x, sheet.y, width, k_header * letter};
    layout.footer = {x, sheet.bottom() - k_footer * letter, width, k_footer * letter};
    layout.plot = {x, layout.header.bottom(), width, std::max(1.0, layout.footer.y - layout.header.bottom())};
    return layout;
}

Projection::Projection(const View& view, const Rect& plot)
    : scale_(std::min(plot.width / view.width(), plot.height / view.height())) {
    const Vec2 middle = 0.5 * (view.lower + view.upper);
    origin_ = {plot.centre_x() - scale_ * middle.x(), plot.centre_y() + scale_ * middle.y()};
}

}  // namespace polargrain
