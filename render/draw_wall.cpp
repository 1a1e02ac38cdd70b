#include <algorithm>
#include <cmath>

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
    const bool closed = last > 1 && (chain.front() - chain.back()).squaredNorm() < 1e-12;
    std::vector<Vec2> normals;
    for (std::size_t k = 0; k < last; ++k) normals.push_back(solid_side(chain[k], chain[k + 1]));
    std::vector<Vec2> edge;
    for (std::size_t k = 0; k <= last; ++k) {
        const Vec2& before = k > 0 ? normals[k - 1] : closed ? normals.back() : normals.front();
        const Vec2& after = k < last ? normals[k] : closed ? normals.front() : normals.back();
        edge.emplace_back(chain[k] + mitre(before, after, band));
    }
    return edge;
}

void trace_band(cairo_t* cr, const std::vector<Vec2>& chain, double band) {
    const std::vector<Vec2> edge = far_edge(chain, band);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        for (const Vec2& p : {chain[k], chain[k + 1], edge[k + 1], edge[k]}) cairo_line_to(cr, p.x(), p.y());
        cairo_close_path(cr);
    }
}

/// Slanting lines all over the clip, fixed to the wall so that they move and turn with it.
void hatch(cairo_t* cr, const Vec2& anchor, const Pose& pose, double spacing) {
    const Saved saved(cr);
    const cairo_matrix_t with_wall = {pose.cosine, -pose.sine, pose.sine, pose.cosine, anchor.x(), anchor.y()};
    cairo_transform(cr, &with_wall);
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
    cairo_clip_extents(cr, &left, &top, &right, &bottom);
    const double height = bottom - top;
    const auto first = static_cast<long>(std::floor((left + top) / spacing));
    const auto last = static_cast<long>(std::ceil((right + bottom) / spacing));
    for (long k = first; k <= last; ++k) {
        const double x = static_cast<double>(k) * spacing - top;  // on x + y = k spacing, at the top
        cairo_move_to(cr, x, top);
        cairo_line_to(cr, x - height, bottom);
    }
    cairo_stroke(cr);
}

}  // namespace

void draw_wall(cairo_t* cr, const PlacedWall& wall, const Projection& to_paper, double band) {
    const std::vector<Vec2> chain = on_paper(wall, to_paper);
    if (chain.size() < 2) return;
    {
        const Saved saved(cr);
        trace_band(cr, chain, band);
        cairo_clip(cr);
        set_colour(cr, k_band);
        cairo_paint(cr);
        set_colour(cr, k_hatch);
        cairo_set_line_width(cr, std::max(0.6, 0.08 * band));
        hatch(cr, to_paper(wall.pose.centre), wall.pose, 0.7 * band);
    }
    const Saved saved(cr);
    set_colour(cr, k_ink);
    cairo_set_line_width(cr, std::max(1.0, 0.18 * band));
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    for (const Vec2& p : chain) cairo_line_to(cr, p.x(), p.y());
    cairo_stroke(cr);
}

}  // namespace polargrain
