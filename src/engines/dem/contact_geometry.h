#pragma once

#include <vector>

#include "src/engines/dem/overlap_area.h"
#include "src/engines/dem/soft_contact.h"
#include "src/engines/dem/soft_walls.h"
#include "src/geometry/shape.h"
#include "src/model/dem_settings.h"

namespace polargrain {

/// Force and energy of overlaps that are measured by their area [FO04].
///
/// W = (k / 2) (tau R)^2 (A / (tau R^2))^q with the linear stiffness k [N/m^2], the smaller inner radius R [m] and the
/// target overlap tau: a face as wide as R that is pressed in by tau R stores what a linear spring k would. The force
/// is dW/dA x width.
struct AreaEnergy {
    double exponent = 2.0;  ///< q > 1
    double target = 0.05;   ///< tau

    /// Energy [J/m] and its derivative by the area [N/m^2].
    struct Value {
        double energy = 0.0;
        double slope = 0.0;
    };
    Value at(double area, double stiffness, double radius) const;
};

/// Finds where two overlapping bodies touch, with force and energy where the geometry decides them. Appends to
/// `touches`.
///
/// Keeps memory between calls; one for each thread. Normals out of the first body into the second.
class TouchFinder {
public:
    explicit TouchFinder(const DemSettings& settings);

    /// Two grains, not both disks. `stiffness`: linear, of their materials [N/m^2].
    void find(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double stiffness,
              std::vector<Touch>& touches);

    /// A wall piece and a polygon. Walls are thin and act on both sides: the wall is a box on that side of the piece on
    /// which it has less in common with the grain, as deep as the grain's inner radius. So the energy has no jump where
    /// a grain passes an end of the piece, on whichever side its centre is.
    void find(const SoftPiece& piece, const PolarPolygon& grain, const Pose& pose, double stiffness,
              std::vector<Touch>& touches);

private:
    void find(const PolarPolygon& a, const Pose& pose_a, const PolarPolygon& b, const Pose& pose_b, double stiffness,
              std::vector<Touch>& touches);
    void add_regions(std::span<const OverlapRegion> regions, const Pose& frame, double stiffness, double radius,
                     std::vector<Touch>& touches) const;

    PolygonContact polygons_;
    AreaEnergy energy_;
    OverlapArea overlap_;
};

/// Touches of a disk (the second body) and a polygon: one for each face that it presses on and each corner that it lies
/// over; exact, force by depth. None where the disk's centre is inside the polygon.
void touch_polygon(const PolarPolygon& polygon, const Pose& pose, const Vec2& centre, double radius,
                   std::vector<Touch>& touches);

}  // namespace polargrain
