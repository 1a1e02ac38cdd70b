#include "src/detect/penetration.h"

#include "src/detect/facing.h"

namespace polargrain {

void vertices_inside(const PolarPolygon& owner, const PolarPolygon& other, const Pose& relative, double tolerance,
                     std::vector<InsideVertex>& found) {
    found.clear();
    const double reach = other.outer_radius() * other.outer_radius();
    any_facing_vertex(owner, relative, reach_towards(other, relative), [&](int k) {
        const Vec2 p = relative.to_world(owner.vertex(k));
        if (p.squaredNorm() >= reach) return false;
        const int sector = other.sector_of(p);
        const double depth = other.depth(p, sector);
        if (depth > tolerance) found.push_back({k, sector, depth});
        return false;
    });
}

}  // namespace polargrain
