#pragma once

#include <memory>
#include <string>
#include <vector>

#include "src/model/scene.h"

namespace polargrain::testing {

/// A scene with one material (density 2000) and gravity downwards; walls and grains are added by the functions below.
Scene empty_scene(double restitution, double friction, double gravity = 9.81);

/// Open chain of wall pieces; the free side on the left.
void add_wall(Scene& scene, const std::string& name, std::vector<Vec2> points, WallMotion motion = {});

/// Box of the given width, open at the top: left wall, floor and right wall in one chain, the corner at the origin.
void add_box(Scene& scene, double width, double height);

/// More than four vertices lie on its sides.
ShapeIndex add_rectangle(Scene& scene, double width, double height, int vertices = 4);
ShapeIndex add_disk(Scene& scene, double radius);
ShapeIndex add_star(Scene& scene, double radius, double inner_radius, int points);
ShapeIndex add_stick(Scene& scene, double length, double width);

/// A star-shaped 24-gon of mean radius `radius` that varies by about `roughness` of it, its own for each draw.
ShapeIndex add_rough(Scene& scene, double radius, double roughness, std::uint64_t draw);

/// What shape a grain of a pour takes.
enum class PourShape { rough, disk, star, stick, mixed };

/// n grains of diameter about 20 mm above a box 20 (or `columns`) diameters wide, in rows that do not touch, with small
/// random velocities and angles drawn from the seed.
Scene pour(PourShape shape, int n, std::uint64_t seed, double restitution, double friction, int columns = 20);

/// n grains of one shipped outline, scaled to an outer radius of 10 mm, in rows of `across` above a box a little wider.
Scene pour_outline(const std::string& outline, int n, int across, std::uint64_t seed);

/// Names of the outlines in the library.
std::vector<std::string> shipped_outlines();

/// A name as GoogleTest takes it: letters, digits and underscores.
std::string test_name(std::string name);

/// The scene seen in a mirror that swaps left and right; polygons only.
Scene mirrored(Scene scene);

/// Number of pairs of grains, and of grains and wall pieces, that overlap by more than `tolerance` [m]; found without
/// any of the program's own detection: outlines as points, segments against segments and winding numbers.
int count_overlaps(const Scene& scene, const Grains& grains, double time, double tolerance);

}  // namespace polargrain::testing
