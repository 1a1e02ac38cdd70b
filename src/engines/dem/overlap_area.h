#pragma once

#include <span>
#include <vector>

#include "src/geometry/polar_polygon.h"
#include "src/geometry/pose.h"

namespace polargrain {

/// A straight edge of an outline, run through counter-clockwise.
struct OutlineEdge {
    Vec2 from;
    Vec2 to;
};

/// One connected region that two outlines, a and b, have in common.
///
/// A piece of a's outline that lies inside b, from crossing point p to q, adds the quarter-turned chord q - p to the
/// integral of a's outward normal, and that integral acts at the chord's middle. So the crossing points and the area
/// are all that an energy of the area needs: its gradient with respect to b's position is dW/dA x -width x normal.
struct OverlapRegion {
    double area = 0.0;            ///< [m^2]
    double width = 0.0;           ///< length of the chord, or of the sum of chords [m]
    double depth = 0.0;           ///< extent along the normal [m]
    Vec2 point = Vec2::Zero();    ///< on the line along which the force acts: the chord's middle; frame of the edges
    Vec2 normal = Vec2::UnitY();  ///< unit, across the chord, out of a into b
};

/// The regions that two outlines have in common.
///
/// Keeps its memory between calls; one for each thread.
class OverlapArea {
public:
    /// Regions of polygon a (in its own frame, which is that of the result) and polygon b at a pose in it; valid until
    /// the next call. Any star-shaped outlines, convex or not, of which neither holds the other's centre.
    std::span<const OverlapRegion> find(const PolarPolygon& a, const PolarPolygon& b, const Pose& pose);

    /// The same for the box a that stands for a wall and a grain, both in the grain's frame: four corners
    /// counter-clockwise, of which the first two bound the face.
    std::span<const OverlapRegion> find(std::span<const Vec2, 4> a, const PolarPolygon& b);

    /// What they have in common [m^2], also where one lies within the other.
    double area(std::span<const Vec2, 4> a, const PolarPolygon& b);

private:
    struct Crossing {
        int edge_a, edge_b;
        double along_a, along_b;
        Vec2 point;
        bool enters;  ///< a's outline enters b
        int next_on_a, next_on_b;
        bool used;
    };

    void find_regions();
    void find_crossings();
    void link_crossings();
    void follow_loop(std::size_t start);
    bool walk(const std::vector<OutlineEdge>& edges, int first, double along_first, int last, double along_last);

    std::vector<OutlineEdge> a_, b_;
    std::vector<Crossing> crossings_;
    std::vector<int> order_;
    std::vector<Vec2> loop_, uncut_;
    std::vector<OverlapRegion> regions_;
};

}  // namespace polargrain
