#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/geometry/shape.h"

namespace polargrain {

/// Draws a shape large: outline, the polar sectors from the centre of mass, circles of outer and inner radius, vertex
/// numbers where there are at most 40, a scale bar, and the given lines of text in a column beside it. `width` pixels
/// wide, 0.7 of that high; png, svg or pdf by the extension; InputError, RunError as draw_frame.
void draw_shape(const Shape& shape, const std::vector<std::string>& properties, const std::filesystem::path& path,
                int width = 1000);

/// "area 1.234e-4 m^2", ...: area, polar moment, radii, vertex count, one line each.
std::vector<std::string> describe_shape(const Shape& shape);

}  // namespace polargrain
