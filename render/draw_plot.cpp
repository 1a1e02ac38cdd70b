#include <algorithm>
#include <cmath>

#include "render/painting.h"
#include "src/core/elementary.h"

namespace polargrain {

namespace {

constexpr Colour k_ground{0.988, 0.988, 0.982};
constexpr Colour k_border{0.80, 0.82, 0.84};

Vec2 mean_of(const std::vector<Vec2>& points) {
    Vec2 sum = Vec2::Zero();
    for (const Vec2& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

}  // namespace

void draw_contacts(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Projection& to_paper,
                   double letter) {
    const Saved saved(cr);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    set_colour(cr, k_impulse_ink, 0.9);
    for (const Contact& contact : picture.contacts) {
        const Vec2 point = to_paper(contact.point);
        const double impulse = contact.impulse.norm();
        if (impulse > 0.0) {
            const Vec2 along(contact.impulse.x() / impulse, -contact.impulse.y() / impulse);
            const double half = 0.45 * letter;
            // By the root: resting and hitting differ by orders of magnitude and both are to be seen.
            cairo_set_line_width(cr, 0.4 * letter * std::sqrt(std::min(1.0, impulse / style.impulse_scale)));
            cairo_move_to(cr, point.x() - half * along.x(), point.y() - half * along.y());
            cairo_line_to(cr, point.x() + half * along.x(), point.y() + half * along.y());
            cairo_stroke(cr);
        }
        cairo_arc(cr, point.x(), point.y(), 0.11 * letter, 0.0, 2.0 * k_pi);
        cairo_fill(cr);
    }
}

double chain_thickness(const FrameStyle& style, double impulse, double scale) {
    return 0.8 * style.grain_radius * scale * std::min(1.0, impulse / style.chain_scale);
}

void draw_chains(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Projection& to_paper) {
    const Saved saved(cr);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    set_colour(cr, k_chain_ink);
    for (const Contact& contact : picture.contacts) {
        const double thickness = chain_thickness(style, contact.impulse.norm(), to_paper.scale());
        constexpr double k_least = 0.15;  // thinner lines are not seen
        if (thickness < k_least) continue;
        cairo_set_line_width(cr, thickness);
        if (!is_wall(contact.a)) {
            const Vec2 from = to_paper(picture.grains.position(contact.a));
            cairo_move_to(cr, from.x(), from.y());
        }
        const Vec2 point = to_paper(contact.point);
        cairo_line_to(cr, point.x(), point.y());
        const Vec2 to = to_paper(picture.grains.position(contact.b));
        cairo_line_to(cr, to.x(), to.y());
        cairo_stroke(cr);
    }
}

View view_at(const Picture& picture, const FrameStyle& style) {
    View view = style.view;
    for (const PlacedWall& wall : picture.walls) {
        if (wall.number != style.follow) continue;
        const Vec2 moved =
            mean_of(wall.points) - mean_of(picture.scene.walls[static_cast<std::size_t>(wall.number)].points);
        view.lower += moved;
        view.upper += moved;
    }
    return view;
}

void draw_plot(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Rect& plot, double letter) {
    const Projection to_paper(view_at(picture, style), plot);
    {
        const Saved saved(cr);
        cairo_rectangle(cr, plot.x, plot.y, plot.width, plot.height);
        cairo_clip(cr);
        set_colour(cr, k_ground);
        cairo_paint(cr);
        for (const PlacedWall& wall : picture.walls) draw_wall(cr, wall, to_paper, 0.7 * letter, plot);
        draw_grains(cr, picture, style, to_paper, plot);
        if (style.colour == ColourBy::force) draw_chains(cr, picture, style, to_paper);
        if (style.contacts) draw_contacts(cr, picture, style, to_paper, letter);
    }
    const Saved saved(cr);
    set_colour(cr, k_border);
    cairo_set_line_width(cr, 1.0);
    cairo_rectangle(cr, std::floor(plot.x) + 0.5, std::floor(plot.y) + 0.5, std::floor(plot.width),
                    std::floor(plot.height));
    cairo_stroke(cr);
}

}  // namespace polargrain
