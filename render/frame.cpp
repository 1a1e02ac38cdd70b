#include "render/frame.h"

#include "render/painting.h"

namespace polargrain {

void draw_frame(const Picture& picture, const FrameStyle& style, const std::filesystem::path& path) {
    Canvas canvas(path, style.width, style.height);
    const FrameLayout layout = frame_layout(canvas.sheet());
    cairo_t* cr = canvas.context();
    draw_plot(cr, picture, style, layout.plot, layout.letter);
    draw_header(cr, layout.header, layout.letter, style.title, time_text(picture.time, style.time_decimals));
    draw_legend(cr, layout.footer, layout.letter, style, picture.scene);
    draw_scale_bar(cr, layout.footer, layout.letter, Projection(style.view, layout.plot).scale());
    canvas.finish();
}

}  // namespace polargrain
