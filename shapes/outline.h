#pragma once

#include <span>
#include <string>

#include "src/core/vec2.h"
#include "src/geometry/mass_properties.h"
#include "src/geometry/polar_polygon.h"

namespace polargrain {

/// Area, centroid and polar moment about the centroid of a simple outline in either orientation (CGAL).
/// Units as the points: [m^2], [m], [m^4]. Throws InputError naming the edges that cross, where it is not simple.
MassProperties mass_properties(const std::string& name, std::span<const Vec2> points);

/// Makes a grain shape of a drawn outline: checks with exact predicates that it is simple and star-shaped about its
/// centroid (InputError names the vertex, counted from 0 as given), turns it counter-clockwise and moves the centroid
/// to the origin. Vertices that repeat their predecessor are refused.
PolarPolygon prepare_outline(const std::string& name, std::span<const Vec2> points);

}  // namespace polargrain
