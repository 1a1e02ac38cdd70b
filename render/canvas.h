#pragma once

// Private to this folder: Cairo's objects, owned, and errors as exceptions.

#include <cairo.h>

#include <filesystem>
#include <span>
#include <string>

namespace polargrain {

/// A rectangle of the paper [pixel], y downwards.
struct Rect {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
    double centre_x() const { return x + 0.5 * width; }
    double centre_y() const { return y + 0.5 * height; }
};

/// A white sheet that becomes a file: png, svg or pdf by the extension, InputError for any other.
class Canvas {
public:
    Canvas(std::filesystem::path path, int width, int height);
    /// One that becomes no file: its pixels are to be had.
    Canvas(int width, int height);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    cairo_t* context() const { return context_; }
    Rect sheet() const { return sheet_; }
    /// Writes the file; RunError names it where that fails.
    void finish();
    /// Of a sheet without a file: words 0xXXRRGGBB row by row, from the top.
    std::span<const unsigned char> pixels() const;

private:
    void make_white();
    void check(cairo_status_t status) const;
    void write_vectors();

    std::filesystem::path path_;
    Rect sheet_;
    bool pixels_;
    std::string vectors_;  ///< of a sheet without pixels: the file as drawn so far
    cairo_surface_t* surface_ = nullptr;
    cairo_t* context_ = nullptr;
};

/// A picture read from a PNG file; InputError names a file that is none.
class Image {
public:
    explicit Image(const std::filesystem::path& path);
    ~Image();
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;
    double width() const;
    double height() const;
    /// Scaled into the rectangle.
    void draw(cairo_t* cr, const Rect& place) const;

private:
    cairo_surface_t* surface_;
};

/// Remembers the state of the context (clip, transformation, colour) and brings it back.
class Saved {
public:
    explicit Saved(cairo_t* cr) : cr_(cr) { cairo_save(cr_); }
    ~Saved() { cairo_restore(cr_); }
    Saved(const Saved&) = delete;
    Saved& operator=(const Saved&) = delete;

private:
    cairo_t* cr_;
};

}  // namespace polargrain
