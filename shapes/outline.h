#pragma once

#include <optional>
#include <span>
#include <string>

#include "src/core/vec2.h"
#include "src/geometry/mass_properties.h"
#include "src/geometry/polar_polygon.h"

namespace polargrain {

/// Area, centroid and polar moment about the centroid of an outline in either orientation.
///
/// Units as the points: [m^2], [m], [m^4]. Integrated in exact arithmetic (CGAL) and rounded at the end: good to a few
/// units in the last place wherever the outline lies, and the same bits on every machine. Throws InputError where
/// there are fewer than 3 points, one repeats its predecessor or is not finite, or the outline is not simple (naming
/// the edges that meet; points count from 0 as given).
MassProperties mass_properties(const std::string& name, std::span<const Vec2> points);

/// Makes a grain shape of a drawn outline: turned counter-clockwise, its centroid at the origin.
///
/// Checks with exact predicates that the outline is simple and star-shaped about its centroid; vertices on a straight
/// side are fine. Throws InputError as mass_properties does, and where the outline is not star-shaped, naming the
/// vertex that turns back, counted from 0 as given.
/// Cost: O(n), about 30 microseconds for 24 points; an outline that is refused costs O(n^2).
PolarPolygon prepare_outline(const std::string& name, std::span<const Vec2> points);

/// The same, but nothing instead of an error where the outline is not star-shaped; for outlines drawn at random.
std::optional<PolarPolygon> try_prepare_outline(const std::string& name, std::span<const Vec2> points);

}  // namespace polargrain
