#include "render/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include "src/core/error.h"

namespace polargrain {

namespace {

cairo_surface_t* create_surface(const std::filesystem::path& path, int width, int height) {
    const std::string extension = path.extension().string();
    if (extension == ".png") return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    if (extension == ".svg") return cairo_svg_surface_create(path.c_str(), width, height);
    if (extension == ".pdf") return cairo_pdf_surface_create(path.c_str(), width, height);
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

}  // namespace

Canvas::Canvas(std::filesystem::path path, int width, int height)
    : path_(std::move(path)),
      sheet_{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)},
      pixels_(path_.extension() == ".png"),
      surface_(create_surface(path_, width, height)),
      context_(cairo_create(surface_)) {
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
    if (pixels_) check(cairo_surface_write_to_png(surface_, path_.c_str()));
    cairo_surface_finish(surface_);
    check(cairo_surface_status(surface_));
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
