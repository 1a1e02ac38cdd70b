#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/frame_style.h"
#include "render/picture.h"

namespace polargrain {

/// A picture with its own heading.
struct NamedPicture {
    std::string name;
    Picture picture;
};

/// The style of one frame, with the sheet made large enough for `count` of them: in a row, or where the view is wide,
/// one below the other.
FrameStyle side_by_side_style(FrameStyle one, int count);

/// Draws pictures of the same view beside one another, with one title, time, legend and scale bar: png, svg or pdf.
/// The time in the heading is that of the first picture. style: from side_by_side_style for as many pictures.
/// Errors as draw_frame.
void draw_side_by_side(std::span<const NamedPicture> pictures, const FrameStyle& style,
                       const std::filesystem::path& path);

}  // namespace polargrain
