#pragma once

#include "render/frame_style.h"

namespace polargrain {

/// Height of letters [pixel], from which every margin and strip of a picture of this width is measured.
double letter_height(double width);

/// Height of a frame [pixel] of the given width whose view is `aspect` times as high as wide.
double height_for(double width, double aspect);

}  // namespace polargrain
