#include "render/frame_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "render/layout.h"
#include "render/round_number.h"
#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

constexpr std::array<std::pair<const char*, ColourBy>, 11> k_colours = {{{"speed", ColourBy::speed},
                                                                         {"spin", ColourBy::spin},
                                                                         {"angle", ColourBy::angle},
                                                                         {"kinetic_energy", ColourBy::kinetic_energy},
                                                                         {"size", ColourBy::size},
                                                                         {"id", ColourBy::id},
                                                                         {"shape", ColourBy::shape},
                                                                         {"material", ColourBy::material},
                                                                         {"contacts", ColourBy::contacts},
                                                                         {"force", ColourBy::force},
                                                                         {"none", ColourBy::none}}};

/// Grows to hold what it is shown.
class Bounds {
public:
    void add(const Vec2& p, double reach) {
        lower_ = lower_.cwiseMin(p - Vec2(reach, reach));
        upper_ = upper_.cwiseMax(p + Vec2(reach, reach));
    }
    bool empty() const { return lower_.x() > upper_.x(); }
    View with_margin() const {
        const double margin = 0.04 * std::max(upper_.x() - lower_.x(), upper_.y() - lower_.y());
        return {lower_ - Vec2(margin, margin), upper_ + Vec2(margin, margin)};
    }

private:
    static constexpr double k_infinity = std::numeric_limits<double>::infinity();
    Vec2 lower_{k_infinity, k_infinity};
    Vec2 upper_{-k_infinity, -k_infinity};
};

void add_wall(Bounds& bounds, const Wall& wall) {
    if (const auto* turning = std::get_if<RotationMotion>(&wall.motion)) {
        double reach = 0.0;
        for (const Vec2& p : wall.points) reach = std::max(reach, (p - turning->centre).norm());
        bounds.add(turning->centre, reach);
        return;
    }
    const auto* shaken = std::get_if<SineMotion>(&wall.motion);
    for (const Vec2& p : points_at_rest(wall)) bounds.add(p, shaken != nullptr ? std::abs(shaken->amplitude) : 0.0);
}

View whole_view(const Scene& scene, std::optional<int> followed) {
    Bounds bounds;
    for (int w = 0; w < static_cast<int>(scene.walls.size()); ++w) {
        Wall wall = scene.walls[static_cast<std::size_t>(w)];
        if (w == followed) wall.motion = {};
        add_wall(bounds, wall);
    }
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        bounds.add(scene.grains.position(k), outer_radius(scene.shape_of(k)));
    }
    if (bounds.empty()) return {Vec2(-0.5, -0.5), Vec2(0.5, 0.5)};
    View view = bounds.with_margin();
    if (view.width() == 0.0) view = {view.lower - Vec2(0.5, 0.5), view.upper + Vec2(0.5, 0.5)};
    return view;
}

int even(double pixels) { return 2 * static_cast<int>(std::ceil(0.5 * pixels - 1e-9)); }

int fitting_height(int width, const View& view) {
    const double w = width;
    return even(std::clamp(height_for(w, view.height() / view.width()), w / 5.0, w * 4.0 / 3.0));
}

/// What the scene's own numbers say about how fast and how large things are.
struct Scales {
    double speed = 1.0;           ///< [m/s]
    double mean_mass = 1.0;       ///< [kg/m]
    double mean_radius = 1.0;     ///< [m]
    double least_radius = 0.0;    ///< [m]
    double largest_radius = 1.0;  ///< [m]
};

double speed_scale(const Scene& scene) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    // 0.4: grains that fall freely all the way are few, and a scale made for them shows the rest in one colour.
    double speed = 0.4 * std::sqrt(2.0 * g * largest_drop(scene).height);
    double squares = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) squares += scene.grains.velocity(k).squaredNorm();
    // By the mean square, for the same reason: one grain that is shot into a bed at rest must not set the scale.
    if (!scene.grains.empty()) speed = std::max(speed, 1.5 * std::sqrt(squares / scene.grains.size()));
    for (const Wall& wall : scene.walls) speed = std::max(speed, largest_speed(wall));
    return speed > 0.0 ? round_up(speed) : 1.0;
}

Scales scales_of(const Scene& scene) {
    Scales scales;
    scales.speed = speed_scale(scene);
    const GrainIndex n = scene.grains.size();
    if (n == 0) return scales;
    double mass = 0.0, radius = 0.0;
    scales.least_radius = std::numeric_limits<double>::infinity();
    scales.largest_radius = 0.0;
    for (GrainIndex k = 0; k < n; ++k) {
        const double reach = outer_radius(scene.shape_of(k));
        mass += scene.grains.mass[Grains::at(k)];
        radius += reach;
        scales.least_radius = std::min(scales.least_radius, reach);
        scales.largest_radius = std::max(scales.largest_radius, reach);
    }
    scales.mean_mass = mass / n;
    scales.mean_radius = radius / n;
    return scales;
}

std::pair<double, double> colour_range(ColourBy quantity, const Scales& scales) {
    switch (quantity) {
        case ColourBy::speed: return {0.0, scales.speed};
        case ColourBy::spin: {
            const double spin = round_up(0.3 * scales.speed / scales.mean_radius);
            return {-spin, spin};
        }
        case ColourBy::angle: return {0.0, 2.0 * k_pi};
        case ColourBy::kinetic_energy: return {0.0, round_up(0.5 * scales.mean_mass * scales.speed * scales.speed)};
        case ColourBy::size:
            // Grains all of one size need a scale with two ends nevertheless.
            if (scales.largest_radius - scales.least_radius < 1e-6 * scales.largest_radius) {
                return {0.0, round_up(scales.largest_radius)};
            }
            return {scales.least_radius, scales.largest_radius};
        case ColourBy::contacts: return {0.0, 8.0};
        case ColourBy::id:
        case ColourBy::shape:
        case ColourBy::material:
        case ColourBy::force:
        case ColourBy::none: break;
    }
    return {0.0, 1.0};
}

void set_colour_scale(FrameStyle& style, const FrameSettings& settings, const Scales& scales) {
    std::tie(style.colour_min, style.colour_max) = colour_range(style.colour, scales);
    if (!settings.colour_max || style.colour == ColourBy::angle) return;
    if (style.colour == ColourBy::force && style.time_step > 0.0) {
        style.chain_scale = *settings.colour_max * style.time_step;
        return;
    }
    style.colour_max = *settings.colour_max;
    if (style.colour == ColourBy::spin) style.colour_min = -style.colour_max;
}

std::optional<int> followed_wall(const FrameSettings& settings, const Scene& scene) {
    if (!settings.follow) return {};
    const auto found = std::ranges::find(scene.walls, *settings.follow, &Wall::name);
    require(found != scene.walls.end(), "follow: no wall is named {}", *settings.follow);
    return static_cast<int>(found - scene.walls.begin());
}

/// Enough to tell neighbouring frames apart, with one more digit: frames come at the first step after their time.
int decimals_for(double every) {
    if (every <= 0.0) return 3;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(every) - 1e-9)) + 1, 2, 7);
}

}  // namespace

std::vector<std::string> colour_names() {
    std::vector<std::string> names;
    for (const auto& [word, quantity] : k_colours) names.emplace_back(word);
    return names;
}

ColourBy colour_by(std::string_view name) {
    for (const auto& [word, quantity] : k_colours) {
        if (name == word) return quantity;
    }
    const std::vector<std::string> known = colour_names();
    throw InputError(fmt::format(R"(colour "{}" is not known; the nearest is "{}" (one of {}))", name,
                                 nearest_name(name, known), fmt::join(known, ", ")));
}

FrameStyle make_frame_style(const FrameSettings& settings, const Scene& scene, std::string title, double time_step) {
    FrameStyle style;
    style.title = std::move(title);
    style.follow = followed_wall(settings, scene);
    style.view = settings.view ? View{settings.view->first, settings.view->second} : whole_view(scene, style.follow);
    style.width = even(settings.width);
    style.height = settings.height > 0 ? even(settings.height) : fitting_height(style.width, style.view);
    style.colour = colour_by(settings.colour);
    style.contacts = settings.contacts;
    style.time_decimals = decimals_for(settings.every);
    const Scales scales = scales_of(scene);
    style.time_step = time_step;
    style.grain_radius = scales.mean_radius;
    style.impulse_scale = scales.mean_mass * scales.speed;
    const double weight = scales.mean_mass * std::sqrt(scene.gravity.squaredNorm());
    style.chain_scale = weight * time_step > 0.0 ? round_up(40.0 * weight) * time_step : style.impulse_scale;
    set_colour_scale(style, settings, scales);
    return style;
}

}  // namespace polargrain
