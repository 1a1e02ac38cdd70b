#include "render/frame.h"

#include "render/painting.h"

namespace polargrain {

void paint_frame(cairo_t* cr, const Rect& sheet, const Picture& picture, const FrameStyle& style) {
    const FrameLayout layout = frame_layout(sheet);
    draw_plot(cr, picture, style, layout.plot, layout.letter);
    draw_header(cr, layout.header, layout.letter, style.title, time_text(picture.time, style.time_decimals));
    const double scale = Projection(style.view, layout.plot).scale();
    draw_legend(cr, layout.footer, layout.letter, style, picture.scene, scale);
    draw_scale_bar(cr, layout.footer, layout.letter, scale);
}

void draw_frame(const Picture& picture, const FrameStyle& style, const std::filesystem::path& path) {
    Canvas canvas(path, style.width, style.height);
    paint_frame(canvas.context(), canvas.sheet(), picture, style);
    canvas.finish();
}

}  // namespace polargrain
