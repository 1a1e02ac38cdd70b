#include "render/colour_map.h"

#include <algorithm>
#include <array>

namespace polargrain {

namespace {

/// From index 16 of 256 on.
constexpr std::array<Colour, 16> k_viridis = {{{0.282327, 0.094955, 0.417331},
                                               {0.278826, 0.175490, 0.483397},
                                               {0.258965, 0.251537, 0.524736},
                                               {0.229739, 0.322361, 0.545706},
                                               {0.199430, 0.387607, 0.554642},
                                               {0.172719, 0.448791, 0.557885},
                                               {0.149039, 0.508051, 0.557250},
                                               {0.127568, 0.566949, 0.550556},
                                               {0.120638, 0.625828, 0.533488},
                                               {0.157851, 0.683765, 0.501686},
                                               {0.246070, 0.738910, 0.452024},
                                               {0.369214, 0.788888, 0.382914},
                                               {0.515992, 0.831158, 0.294279},
                                               {0.678489, 0.863742, 0.189503},
                                               {0.845561, 0.887322, 0.099702},
                                               {0.993248, 0.906157, 0.143936}}};

constexpr std::array<Colour, 7> k_blue_white_red = {{{0.129, 0.400, 0.675},
                                                     {0.404, 0.663, 0.812},
                                                     {0.820, 0.898, 0.941},
                                                     {0.969, 0.969, 0.969},
                                                     {0.992, 0.859, 0.780},
                                                     {0.937, 0.541, 0.384},
                                                     {0.698, 0.094, 0.169}}};

constexpr std::array<Colour, 9> k_twilight = {{{0.886, 0.850, 0.888},
                                               {0.651, 0.749, 0.792},
                                               {0.424, 0.557, 0.749},
                                               {0.369, 0.310, 0.659},
                                               {0.184, 0.078, 0.216},
                                               {0.455, 0.098, 0.310},
                                               {0.686, 0.310, 0.314},
                                               {0.804, 0.639, 0.541},
                                               {0.886, 0.850, 0.888}}};

constexpr std::array<Colour, 8> k_categories = {{{0.337, 0.706, 0.914},
                                                 {0.902, 0.624, 0.000},
                                                 {0.000, 0.620, 0.451},
                                                 {0.941, 0.894, 0.259},
                                                 {0.000, 0.447, 0.698},
                                                 {0.835, 0.369, 0.000},
                                                 {0.800, 0.475, 0.655},
                                                 {0.600, 0.600, 0.600}}};

}  // namespace

std::span<const Colour> colour_anchors(ColourBy quantity) {
    switch (quantity) {
        case ColourBy::speed:
        case ColourBy::kinetic_energy:
        case ColourBy::contacts:
        case ColourBy::size: return k_viridis;
        case ColourBy::spin: return k_blue_white_red;
        case ColourBy::angle: return k_twilight;
        case ColourBy::id:
        case ColourBy::shape:
        case ColourBy::material:
        case ColourBy::force:
        case ColourBy::none: break;
    }
    return {};
}

Colour colour_at(std::span<const Colour> anchors, double place) {
    const double last = static_cast<double>(anchors.size() - 1);
    const double at = std::clamp(place, 0.0, 1.0) * last;
    const auto below = static_cast<std::size_t>(std::min(at, last - 1.0));
    const double part = at - static_cast<double>(below);
    const Colour& a = anchors[below];
    const Colour& b = anchors[below + 1];
    return {a.r + part * (b.r - a.r), a.g + part * (b.g - a.g), a.b + part * (b.b - a.b)};
}

Colour category_colour(int category) { return k_categories[static_cast<std::size_t>(category) % k_categories.size()]; }

}  // namespace polargrain
