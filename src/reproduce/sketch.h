#pragma once

#include <string>

#include "src/geometry/pose.h"
#include "src/geometry/shape.h"
#include "src/plot/plot.h"

namespace polargrain {

// Shapes and marks as series of a panel drawn as a map (Panel::map). colour: number in the palette.

Series sketch_shape(const Shape& shape, const Pose& pose, SeriesStyle style, int colour);
Series sketch_point(const Vec2& at, int colour);
Series sketch_arrow(const Vec2& from, const Vec2& by, int colour);
Series sketch_text(const Vec2& at, const std::string& text);

}  // namespace polargrain
