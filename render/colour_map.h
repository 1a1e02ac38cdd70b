#pragma once

#include <span>

#include "render/frame_style.h"

namespace polargrain {

/// Red, green and blue in [0, 1], sRGB.
struct Colour {
    double r = 0.0, g = 0.0, b = 0.0;
};

/// Share of white light that the colour gives back, 0 to 1 (Rec. 709 weights on the sRGB values).
inline double brightness(const Colour& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

inline Colour darker(const Colour& c, double factor) { return {c.r * factor, c.g * factor, c.b * factor}; }

/// Evenly spaced colours from the least to the greatest value, to be interpolated linearly:
/// viridis (van der Walt & Smith 2015) without its darkest sixteenth, in which outlines would drown, for amounts, a
/// blue-white-red map (ColorBrewer RdBu) for spin, and a map that ends as it begins, after matplotlib's twilight, for
/// angles. Empty where the quantity is none or has no scale.
std::span<const Colour> colour_anchors(ColourBy quantity);

/// The colour at a place of the scale; beyond the ends the end colours.
Colour colour_at(std::span<const Colour> anchors, double place);

/// Colours that also the colour-blind can tell apart (Okabe & Ito 2008); eight, then again from the first.
Colour category_colour(int category);

/// What grains are filled with where nothing is shown.
inline constexpr Colour k_plain_fill{0.72, 0.77, 0.82};

/// What they are filled with under force chains, which are to stand out.
inline constexpr Colour k_pale_fill{0.90, 0.92, 0.94};

}  // namespace polargrain
