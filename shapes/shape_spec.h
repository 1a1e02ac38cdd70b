#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "src/core/vec2.h"
#include "src/geometry/shape.h"

namespace polargrain {

// What a scenario file says of a shape; lengths in metres, angles in radians. docs/scenario.md explains each key.

struct RectangleSpec {
    double width = 0.0, height = 0.0;
    int vertices = 4;  ///< more are spread along the sides, by length
};
struct DiskSpec {
    double radius = 0.0;
};
struct RegularSpec {
    double radius = 0.0;  ///< to a vertex
    int sides = 0;        ///< the first vertex lies on the x axis
};
struct EllipseSpec {
    double width = 0.0, height = 0.0;
    int vertices = 32;  ///< on the ellipse, by equal steps of its parameter
};
/// |2 x / width|^exponent + |2 y / height|^exponent = 1.
struct SuperellipseSpec {
    double width = 0.0, height = 0.0;
    double exponent = 2.0;  ///< 0.2 to 100; 2: ellipse, large: rectangle, below 1: four-pointed star
    int vertices = 32;
};
struct StickSpec {
    double length = 0.0, width = 0.0;  ///< length over all, ends rounded with half the width
    int vertices = 16;                 ///< even, half of them on each end
};
struct StarSpec {
    double radius = 0.0, inner_radius = 0.0;
    int points = 5;
};
/// Radius mean x (1 + roughness x f(theta)), f a smooth random Fourier series of the given modes, scaled so that its
/// root mean square over draws is 1 / sqrt(2) (one mode of unit amplitude) and clipped at +-1. Modes above half the
/// number of vertices cannot show and are left out. A draw that is not star-shaped about its centre of mass is drawn
/// again.
struct RoughSpec {
    double radius = 0.0;
    double roughness = 0.0;
    int vertices = 24;
    int first_mode = 2, last_mode = 6;
    bool same = false;  ///< all grains share one draw
};
struct PolarSpec {
    std::vector<std::pair<double, double>> vertices;  ///< radius, angle [rad], rising
};
struct OutlineSpec {
    std::vector<Vec2> points;
};

using ShapeSpec = std::variant<RectangleSpec, DiskSpec, RegularSpec, EllipseSpec, SuperellipseSpec, StickSpec, StarSpec,
                               RoughSpec, PolarSpec, OutlineSpec>;

/// Builds the shape. `draw` numbers the draws of shapes that differ from grain to grain (RoughSpec); it and the seed
/// alone decide the draw. Throws InputError with the offending value and the remedy.
Shape make_shape(const std::string& name, const ShapeSpec& spec, std::uint64_t seed, std::uint64_t draw = 0);

/// True where every grain gets a draw of its own.
bool differs_by_grain(const ShapeSpec& spec);

}  // namespace polargrain
