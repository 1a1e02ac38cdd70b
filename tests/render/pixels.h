#pragma once

#include <cairo.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <ostream>

#include "render/painting.h"

namespace polargrain::testing {

/// A PNG file as it came out.
class Pixels {
public:
    explicit Pixels(const std::filesystem::path& path) : surface_(cairo_image_surface_create_from_png(path.c_str())) {}
    ~Pixels() { cairo_surface_destroy(surface_); }
    Pixels(const Pixels&) = delete;
    Pixels& operator=(const Pixels&) = delete;

    bool valid() const { return cairo_surface_status(surface_) == CAIRO_STATUS_SUCCESS; }
    int width() const { return cairo_image_surface_get_width(surface_); }
    int height() const { return cairo_image_surface_get_height(surface_); }

    /// Of the pixel that holds the point.
    Colour at(const Vec2& point) const {
        const auto column = static_cast<std::ptrdiff_t>(std::floor(point.x()));
        const auto row = static_cast<std::ptrdiff_t>(std::floor(point.y()));
        std::uint32_t pixel = 0;
        std::memcpy(
            &pixel,
            cairo_image_surface_get_data(surface_) + row * cairo_image_surface_get_stride(surface_) + 4 * column,
            sizeof pixel);
        const auto channel = [pixel](unsigned shift) { return static_cast<double>((pixel >> shift) & 0xFFU) / 255.0; };
        return {channel(16), channel(8), channel(0)};
    }

private:
    cairo_surface_t* surface_;
};

/// Largest difference of a channel.
inline double difference(const Colour& a, const Colour& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

inline constexpr double k_alike = 1.5 / 255.0;  ///< rounding to bytes
inline constexpr Colour k_ground_colour{0.988, 0.988, 0.982};

}  // namespace polargrain::testing
