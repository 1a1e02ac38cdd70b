#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/vec2.h"
#include "src/model/scene.h"
#include "src/model/settings.h"

namespace polargrain {

/// What a frame shows of the grains: by their fill, and with `force` by lines between the centres of grains that touch,
/// as thick as the impulse is large.
enum class ColourBy { speed, spin, angle, kinetic_energy, size, id, shape, material, contacts, force, none };

/// The words for them, as after --colour.
std::vector<std::string> colour_names();

/// InputError names the nearest known word.
ColourBy colour_by(std::string_view name);

/// The piece of the plane that a picture shows.
struct View {
    Vec2 lower = Vec2::Zero();  ///< left, bottom [m]
    Vec2 upper = Vec2::Zero();  ///< right, top [m]
    double width() const { return upper.x() - lower.x(); }
    double height() const { return upper.y() - lower.y(); }
};

/// How the frames of one run are drawn; the same for all of them, so that colours and places can be compared.
struct FrameStyle {
    std::string title;
    View view;
    int width = 1280;  ///< [pixel], even
    int height = 720;  ///< [pixel], even
    ColourBy colour = ColourBy::speed;
    double colour_min = 0.0;  ///< in SI units of the quantity; values beyond the ends take the end colours
    double colour_max = 1.0;
    bool contacts = false;
    double impulse_scale = 1.0;  ///< [N s/m] drawn at full thickness
    double chain_scale = 1.0;    ///< [N s/m] drawn at full thickness in force chains
    double time_step = 0.0;      ///< [s] turns impulses into forces; 0: unknown
    double grain_radius = 0.0;   ///< mean outer radius [m]
    int time_decimals = 3;       ///< of the time stamp [s]
    std::optional<int> follow;   ///< number of the wall that the view goes along with, without turning
};

/// Style for all frames of a scene.
///
/// The view is the given one, or all walls (with the reach of their motions) and all grains at time zero with a
/// margin. Sizes are rounded up to even numbers, as movies need. A height of zero follows from the view, between a
/// fifth and 4/3 of the width; where the view has another aspect it is shown whole and centred.
/// A wall that the view follows counts where it is at rest.
/// The colour scale is colour_max, or from the scene alone. Its upper end for speed: the next round number above
/// 0.4 sqrt(2 g H), H the largest drop, above 1.5 times the root mean square of the initial speeds and above the
/// greatest wall speed; for spin 0.3 of that speed over the mean outer radius, both ways; for kinetic energy that of a
/// mean grain at that speed; for size from the least to the greatest outer radius; for contacts from none to eight. The
/// impulse scale is a mean grain's mass times that speed. Force chains are thickest at a round multiple of a mean
/// grain's weight, about forty, so that a bed at rest shows its chains; without gravity or a known time step at the
/// impulse scale.
/// time_step: of the run [s]; 0 where it is not known. InputError for a colour or a followed wall that is not known.
FrameStyle make_frame_style(const FrameSettings& settings, const Scene& scene, std::string title,
                            double time_step = 0.0);

}  // namespace polargrain
