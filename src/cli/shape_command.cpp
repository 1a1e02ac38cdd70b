#include <fmt/format.h>

#include <cmath>

#include "render/shape_picture.h"
#include "shapes/library.h"
#include "shapes/outline.h"
#include "src/cli/commands.h"
#include "src/core/error.h"

namespace polargrain {

namespace {

bool convex(const PolarPolygon& polygon) {
    for (int q = 0; q < polygon.size(); ++q) {
        const Vec2 before = polygon.vertex(q) - polygon.vertex(polygon.previous(q));
        const Vec2 after = polygon.vertex(polygon.next(q)) - polygon.vertex(q);
        // Vertices on a straight side are convex too; round-off must not make them dents.
        if (cross(before, after) < -1e-12 * polygon.outer_radius() * polygon.outer_radius()) return false;
    }
    return true;
}

PolarPolygon grain_of(const OutlineFile& outline) {
    try {
        return prepare_outline(outline.name, outline.points);
    } catch (const InputError& error) {
        throw InputError(SourceLocation{.file = outline.file, .line = 0, .column = 0}, error.what());
    }
}

void print_properties(const OutlineFile& outline, const PolarPolygon& polygon) {
    const Vec2 centroid = mass_properties(outline.name, outline.points).centroid;
    const double area = polygon.area();
    fmt::print("{}: {}\n", outline.name, outline.title);
    fmt::print("  source            {}\n", outline.source);
    fmt::print("  vertices          {}\n", polygon.size());
    fmt::print("  area              {:.6g} m^2\n", area);
    fmt::print("  centroid          ({:.6g}, {:.6g}) m in the file; the origin of the grain\n", centroid.x(),
               centroid.y());
    fmt::print("  polar moment      {:.6g} m^4 about the centroid (times density: inertia per metre of depth)\n",
               polygon.polar_moment());
    fmt::print("  gyration radius   {:.6g} m\n", std::sqrt(polygon.polar_moment() / area));
    fmt::print("  outer radius      {:.6g} m (R_max)\n", polygon.outer_radius());
    fmt::print("  inner radius      {:.6g} m (R_in)\n", polygon.inner_radius());
    fmt::print("  star-shaped       yes, about the centroid\n");
    fmt::print("  convex            {}\n", convex(polygon) ? "yes" : "no");
}

}  // namespace

int shape_command(const ShapeRequest& request) {
    const OutlineFile outline = find_outline(request.shape, std::filesystem::current_path());
    const PolarPolygon polygon = grain_of(outline);
    if (request.picture) {
        require(request.force || !std::filesystem::exists(*request.picture),
                "{}: is there already; give another name with -o, or --force to replace it", request.picture->string());
    }
    print_properties(outline, polygon);
    if (!request.picture) return k_exit_done;
    const Shape shape = polygon;
    draw_shape(shape, describe_shape(shape), *request.picture);
    fmt::print("  picture           {}\n", request.picture->string());
    return k_exit_done;
}

}  // namespace polargrain
