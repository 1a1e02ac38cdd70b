#include "src/reproduce/sketch.h"

namespace polargrain {

namespace {

constexpr int k_circle = 72;
constexpr int k_ink = 6;

}  // namespace

Series sketch_shape(const Shape& shape, const Pose& pose, SeriesStyle style, int colour) {
    Series series{.style = style, .colour = colour};
    const auto add = [&](const Vec2& local) {
        const Vec2 p = pose.to_world(local);
        series.x.push_back(p.x());
        series.y.push_back(p.y());
    };
    if (const auto* polygon = std::get_if<PolarPolygon>(&shape)) {
        for (const Vec2& v : polygon->vertices()) add(v);
    } else {
        const double radius = outer_radius(shape);
        for (int k = 0; k < k_circle; ++k) {
            const auto [s, c] = sine_cosine(2.0 * k_pi * k / k_circle);
            add({radius * c, radius * s});
        }
    }
    return series;
}

Series sketch_point(const Vec2& at, int colour) {
    return {.style = SeriesStyle::points, .x = {at.x()}, .y = {at.y()}, .colour = colour};
}

Series sketch_arrow(const Vec2& from, const Vec2& by, int colour) {
    return {.style = SeriesStyle::arrows,
            .x = {from.x()},
            .y = {from.y()},
            .dx = {by.x()},
            .dy = {by.y()},
            .colour = colour};
}

Series sketch_text(const Vec2& at, const std::string& text) {
    return {.style = SeriesStyle::labels, .x = {at.x()}, .y = {at.y()}, .texts = {text}, .colour = k_ink};
}

}  // namespace polargrain
