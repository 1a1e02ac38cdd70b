#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "render/frame_style.h"
#include "render/picture.h"
#include "render/side_by_side.h"

namespace polargrain {

/// True where ffmpeg is installed.
bool can_make_movies();

/// InputError where it is not; path: of the movie that was to be made.
void require_movies(const std::filesystem::path& path);

/// Frames as a movie: drawn as draw_frame does, and handed to the program ffmpeg one after the other.
///
/// H.264 in MP4, with 4:2:0 colours, which every player takes. Written into a folder beside its place and moved there
/// at the end. Equal frames give equal bytes with the same ffmpeg. InputError where ffmpeg is not installed, RunError
/// where it fails, with what it has to say.
class Movie {
public:
    /// Size from the style; frames_per_second of the movie.
    Movie(std::filesystem::path path, FrameStyle style, double frames_per_second);
    ~Movie();
    Movie(const Movie&) = delete;
    Movie& operator=(const Movie&) = delete;

    void add(const Picture& picture);
    /// Drawn as draw_side_by_side does.
    void add(std::span<const NamedPicture> side_by_side);
    void finish();

private:
    class Encoder;
    std::filesystem::path path_;
    FrameStyle style_;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace polargrain
