#include "render/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>
#include <png.h>

#include <cstring>
#include <vector>

#include "src/core/error.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace {

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

/// Vectors go into a text: where Cairo writes the file itself, it forgets errors on the way.
cairo_surface_t* create_surface(const std::filesystem::path& path, int width, int height, std::string& vectors) {
    const std::string extension = path.extension().string();
    if (extension == ".png") return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    if (extension == ".svg") return cairo_svg_surface_create_for_stream(append, &vectors, width, height);
    if (extension == ".pdf") return cairo_pdf_surface_create_for_stream(append, &vectors, width, height);
    throw InputError(
        fmt::format("{}: cannot draw into a file of this kind; end its name in .png, .svg or .pdf", path.string()));
}

/// Fonts look alike whatever the desktop's own settings are.
void settle_fonts(cairo_t* cr) {
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cr, options);
    cairo_font_options_destroy(options);
}

/// Red, green, blue, one byte each, row by row, of a surface whose pixels are words 0xXXRRGGBB.
std::vector<png_byte> bytes_of(cairo_surface_t* surface, int width, int height) {
    cairo_surface_flush(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
    std::vector<png_byte> bytes(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    png_byte* next = bytes.data();
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
            std::uint32_t pixel = 0;
            std::memcpy(&pixel, data + y * stride + 4 * x, sizeof pixel);
            *next++ = static_cast<png_byte>(pixel >> 16U);
            *next++ = static_cast<png_byte>(pixel >> 8U);
            *next++ = static_cast<png_byte>(pixel);
        }
    }
    return bytes;
}

/// Cairo's own writer would do, but takes five times as long to save an eighth of the size.
void write_png(cairo_surface_t* surface, const std::filesystem::path& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(cairo_image_surface_get_width(surface));
    image.height = static_cast<png_uint_32>(cairo_image_surface_get_height(surface));
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    const std::vector<png_byte> bytes =
        bytes_of(surface, static_cast<int>(image.width), static_cast<int>(image.height));
    if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) != 0) return;
    throw RunError(fmt::format("{}: cannot write the picture: {}", path.string(), image.message));
}

}  // namespace

Canvas::Canvas(std::filesystem::path path, int width, int height)
    : path_(std::move(path)),
      sheet_{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)},
      pixels_(path_.extension() == ".png"),
      surface_(create_surface(path_, width, height, vectors_)),
      context_(cairo_create(surface_)) {
    make_white();
}

Canvas::Canvas(int width, int height)
    : sheet_{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)},
      pixels_(true),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      context_(cairo_create(surface_)) {
    make_white();
}

void Canvas::make_white() {
    settle_fonts(context_);
    cairo_set_source_rgb(context_, 1.0, 1.0, 1.0);
    cairo_paint(context_);
}

Canvas::~Canvas() {
    cairo_destroy(context_);
    cairo_surface_destroy(surface_);
}

void Canvas::finish() {
    check(cairo_status(context_));
    check(cairo_surface_status(surface_));
    try {
        pixels_ ? write_png(surface_, path_) : write_vectors();
    } catch (const RunError&) {
        // Half a picture is none.
        std::error_code left;
        if (std::filesystem::is_regular_file(path_, left)) std::filesystem::remove(path_, left);
        throw;
    }
}

void Canvas::write_vectors() {
    cairo_surface_finish(surface_);
    check(cairo_surface_status(surface_));
    TextFile file(path_);
    file.write(vectors_);
    file.close();
}

std::span<const unsigned char> Canvas::pixels() const {
    cairo_surface_flush(surface_);
    const auto height = static_cast<std::size_t>(cairo_image_surface_get_height(surface_));
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_));
    return {cairo_image_surface_get_data(surface_), height * stride};
}

void Canvas::check(cairo_status_t status) const {
    if (status == CAIRO_STATUS_SUCCESS) return;
    throw RunError(fmt::format("{}: cannot write the picture: {}", path_.string(), cairo_status_to_string(status)));
}

Image::Image(const std::filesystem::path& path) : surface_(cairo_image_surface_create_from_png(path.c_str())) {
    const cairo_status_t status = cairo_surface_status(surface_);
    if (status == CAIRO_STATUS_SUCCESS) return;
    cairo_surface_destroy(surface_);
    throw InputError(fmt::format("{}: cannot read the picture: {}", path.string(), cairo_status_to_string(status)));
}

Image::~Image() { cairo_surface_destroy(surface_); }

double Image::width() const { return cairo_image_surface_get_width(surface_); }

double Image::height() const { return cairo_image_surface_get_height(surface_); }

void Image::draw(cairo_t* cr, const Rect& place) const {
    const Saved saved(cr);
    cairo_translate(cr, place.x, place.y);
    cairo_scale(cr, place.width / width(), place.height / height());
    cairo_set_source_surface(cr, surface_, 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_BEST);
    // Beyond its edge the picture repeats its last pixels, so that no pale seam is drawn around it.
    cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD);
    cairo_rectangle(cr, 0.0, 0.0, width(), height());
    cairo_fill(cr);
}

}  // namespace polargrain
