#pragma once

// Private to this folder: the parts that pictures are put together from.

#include <cairo.h>

#include <optional>
#include <string>
#include <vector>

#include "render/canvas.h"
#include "render/colour_map.h"
#include "render/frame_style.h"
#include "render/picture.h"
#include "render/side_by_side.h"

namespace polargrain {

// ---- placing ----

/// Where the parts of a frame stand.
struct FrameLayout {
    double letter;  ///< height of letters [pixel]
    Rect header, plot, footer;
};
FrameLayout frame_layout(const Rect& sheet);

/// From the plane to the paper: the view whole and centred in the plot.
class Projection {
public:
    Projection(const View& view, const Rect& plot);
    double scale() const { return scale_; }  ///< [pixel/m]
    Vec2 operator()(const Vec2& world) const {
        return {origin_.x() + scale_ * world.x(), origin_.y() - scale_ * world.y()};
    }

private:
    double scale_;
    Vec2 origin_;
};

// ---- text ----

enum class Align { left, centre, right };

void set_colour(cairo_t* cr, const Colour& colour, double opacity = 1.0);
void choose_font(cairo_t* cr, double size, bool bold = false);
double text_width(cairo_t* cr, const std::string& text);
/// In the chosen font and colour; y is the base line.
void draw_text(cairo_t* cr, double x, double y, const std::string& text, Align align);
/// The text, shortened with an ellipsis to the given width [pixel] where it is longer.
std::string fitted(cairo_t* cr, const std::string& text, double width);

// ---- what is in the plot ----

/// What the fill of a grain shows, in SI units; its index for ColourBy::id, that of its material for material. Zero for
/// what the grain alone does not tell.
double shown_value(ColourBy quantity, const Scene& scene, const Grains& grains, GrainIndex k);
Colour fill_of(const FrameStyle& style, const Scene& scene, const Grains& grains, GrainIndex k);
/// The colour of a value on the scale of the style.
Colour fill_for(const FrameStyle& style, double value);
/// The different shapes by the names that the scenario gives them, in the order in which they come up.
std::vector<std::string> shape_kinds(const Scene& scene);

void trace(cairo_t* cr, const Shape& shape, const Pose& pose, const Projection& to_paper);
void draw_grains(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Projection& to_paper,
                 const Rect& plot);
/// band: thickness of the hatched side [pixel]; plot: where there is something to be seen.
void draw_wall(cairo_t* cr, const PlacedWall& wall, const Projection& to_paper, double band, const Rect& plot);
void draw_contacts(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Projection& to_paper,
                   double letter);
/// A line from centre to centre through each contact point, as thick as the impulse is large.
void draw_chains(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Projection& to_paper);
/// Thickness of such a line [pixel].
double chain_thickness(const FrameStyle& style, double impulse, double scale);
/// The view of the style, moved along with the wall that it follows: by as much as the mean of that wall's points.
View view_at(const Picture& picture, const FrameStyle& style);
/// All of it, clipped to the plot, in a thin frame.
void draw_plot(cairo_t* cr, const Picture& picture, const FrameStyle& style, const Rect& plot, double letter);

// ---- what is around it ----

std::string time_text(double time, int decimals);
void draw_header(cairo_t* cr, const Rect& header, double letter, const std::string& title,
                 const std::optional<std::string>& time);
/// The legend of the colours at the right; nothing where grains are plain. `scale` [pixel/m].
void draw_legend(cairo_t* cr, const Rect& footer, double letter, const FrameStyle& style, const Scene& scene,
                 double scale);
/// A bar of a round length at the left; `scale` [pixel/m].
void draw_scale_bar(cairo_t* cr, const Rect& footer, double letter, double scale);

inline constexpr Colour k_ink{0.13, 0.15, 0.18};
inline constexpr Colour k_impulse_ink{0.83, 0.07, 0.14};
inline constexpr Colour k_chain_ink{0.55, 0.06, 0.20};

/// A whole frame on the sheet.
void paint_frame(cairo_t* cr, const Rect& sheet, const Picture& picture, const FrameStyle& style);
/// Several frames on one sheet.
void paint_side_by_side(cairo_t* cr, const Rect& sheet, std::span<const NamedPicture> pictures,
                        const FrameStyle& style);

}  // namespace polargrain
