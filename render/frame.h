#pragma once

#include <filesystem>

#include "render/frame_style.h"
#include "render/picture.h"

namespace polargrain {

/// Draws one frame into a file: png, svg or pdf, as its extension says (InputError for any other).
///
/// Grains are filled by the chosen quantity, with a mark from the centre of mass along the grain's own x axis; walls
/// are hatched on their solid side; title, time, colour legend and scale bar stand outside the view. With
/// style.contacts, each contact is a dot, and its impulse a line along the impulse, its thickness by magnitude.
/// Equal input draws equal PNG bytes. RunError names a file that cannot be written.
void draw_frame(const Picture& picture, const FrameStyle& style, const std::filesystem::path& path);

}  // namespace polargrain
