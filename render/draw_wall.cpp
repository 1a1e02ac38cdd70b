#include <algorithm>
#include <cmath>
#include <utility>

#include "render/painting.h"

namespace polargrain {

namespace {

constexpr Colour k_band{0.90, 0.91, 0.92};
constexpr Colour k_hatch{0.55, 0.58, 0.62};

/// The chain on the paper, without points that repeat their predecessor.
std::vector<Vec2> on_paper(const PlacedWall& wall, const Projection& to_paper) {
    std::vector<Vec2> chain;
    for (const Vec2& p : wall.points) {
        const Vec2 q = to_paper(p);
        if (chain.empty() || (q - chain.back()).squaredNorm() > 1e-12) chain.push_back(q);
    }
    return chain;
}

/// Unit vector to the right of the direction of travel; the paper's y runs downwards.
Vec2 solid_side(const Vec2& from, const Vec2& to) { return left_normal(unit(to - from)); }

bool closed(const std::vector<Vec2>& chain) {
    return chain.size() > 3 && (chain.front() - chain.back()).squaredNorm() < 1e-12;
}

/// Where the solid side ends beside a corner between pieces with these normals: the mitre, not longer than 2.5 bands.
Vec2 mitre(const Vec2& before, const Vec2& after, double band) {
    const Vec2 sum = before + after;
    const double squared = sum.squaredNorm();
    if (squared < 1e-9) return band * before;
    const Vec2 offset = (2.0 * band / squared) * sum;
    return offset * std::min(1.0, 2.5 * band / offset.norm());
}

/// Offset of each point of the chain to the far edge of the band.
std::vector<Vec2> far_edge(const std::vector<Vec2>& chain, double band) {
    const std::size_t last = chain.size() - 1;
    const bool round = closed(chain);
    std::vector<Vec2> normals;
    for (std::size_t k = 0; k < last; ++k) normals.push_back(solid_side(chain[k], chain[k + 1]));
    std::vector<Vec2> edge;
    for (std::size_t k = 0; k <= last; ++k) {
        const Vec2& before = k > 0 ? normals[k - 1] : round ? normals.back() : normals.front();
        const Vec2& after = k < last ? normals[k] : round ? normals.front() : normals.back();
        edge.emplace_back(chain[k] + mitre(before, after, band));
    }
    return edge;
}

/// Pieces of the solid side, each as a polygon: all of the inside where the chain goes round it clockwise, otherwise a
/// band along each piece.
std::vector<std::vector<Vec2>> solid_polygons(const std::vector<Vec2>& chain, double band) {
    double twice_area = 0.0;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) twice_area += cross(chain[k], chain[k + 1]);
    // Clockwise in the plane is counter-clockwise in numbers on paper, whose y runs downwards, and so positive.
    if (closed(chain) && twice_area > 0.0) return {chain};
    const std::vector<Vec2> edge = far_edge(chain, band);
    std::vector<std::vector<Vec2>> bands;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) bands.push_back({chain[k], chain[k + 1], edge[k + 1], edge[k]});
    return bands;
}

void trace(cairo_t* cr, const std::vector<Vec2>& polygon) {
    cairo_new_sub_path(cr);
    for (const Vec2& p : polygon) cairo_line_to(cr, p.x(), p.y());
    cairo_close_path(cr);
}

/// Slanting lines within a polygon, cut to it here: a clip would cost Cairo ten times as much. They hang on the wall,
/// line k where x + y = k spacing in its own frame, so that they move and turn with it.
class Hatch {
public:
    Hatch(Vec2 anchor, const Pose& pose, double spacing)
        : anchor_(std::move(anchor)),
          across_(unit(Vec2(pose.cosine + pose.sine, pose.cosine - pose.sine))),
          spacing_(spacing) {}

    void trace(cairo_t* cr, const std::vector<Vec2>& polygon, const Rect& plot) const {
        double low = number_at({plot.x, plot.y}), high = low;
        for (const Vec2& corner :
             {Vec2(plot.right(), plot.y), Vec2(plot.x, plot.bottom()), Vec2(plot.right(), plot.bottom())}) {
            low = std::min(low, number_at(corner));
            high = std::max(high, number_at(corner));
        }
        double first = number_at(polygon.front()), last = first;
        for (const Vec2& p : polygon) {
            first = std::min(first, number_at(p));
            last = std::max(last, number_at(p));
        }
        first = std::ceil(std::max(first, low));
        for (double k = first; k <= std::min(last, high); k += 1.0) trace_line(cr, polygon, k);
    }

private:
    double number_at(const Vec2& p) const { return across_.dot(p - anchor_) / spacing_; }

    void trace_line(cairo_t* cr, const std::vector<Vec2>& polygon, double k) const {
        std::vector<Vec2> cuts;
        for (std::size_t q = 0; q < polygon.size(); ++q) {
            const Vec2& a = polygon[q];
            const Vec2& b = polygon[(q + 1) % polygon.size()];
            const double from = number_at(a) - k, to = number_at(b) - k;
            if ((from < 0.0) != (to < 0.0)) cuts.emplace_back(a + from / (from - to) * (b - a));
        }
        const Vec2 along = left_normal(across_);
        std::sort(cuts.begin(), cuts.end(), [&](const Vec2& a, const Vec2& b) { return along.dot(a) < along.dot(b); });
        for (std::size_t c = 0; c + 1 < cuts.size(); c += 2) {
            cairo_move_to(cr, cuts[c].x(), cuts[c].y());
            cairo_line_to(cr, cuts[c + 1].x(), cuts[c + 1].y());
        }
    }

    Vec2 anchor_;
    Vec2 across_;
    double spacing_;
};

}  // namespace

void draw_wall(cairo_t* cr, const PlacedWall& wall, const Projection& to_paper, double band, const Rect& plot) {
    const std::vector<Vec2> chain = on_paper(wall, to_paper);
    if (chain.size() < 2) return;
    const Saved saved(cr);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    const Hatch hatch(to_paper(wall.pose.centre), wall.pose, 0.55 * band);
    const std::vector<std::vector<Vec2>> solid = solid_polygons(chain, band);
    for (const std::vector<Vec2>& polygon : solid) trace(cr, polygon);
    set_colour(cr, k_band);
    cairo_fill(cr);
    for (const std::vector<Vec2>& polygon : solid) hatch.trace(cr, polygon, plot);
    set_colour(cr, k_hatch);
    cairo_set_line_width(cr, std::max(0.6, 0.07 * band));
    cairo_stroke(cr);
    for (const Vec2& p : chain) cairo_line_to(cr, p.x(), p.y());
    set_colour(cr, k_ink);
    cairo_set_line_width(cr, std::max(1.0, 0.16 * band));
    cairo_stroke(cr);
}

}  // namespace polargrain
