#include "render/movie.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <span>

#include "render/painting.h"
#include "src/core/child_process.h"
#include "src/core/error.h"
#include "src/record/private_folder.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_encoder = "ffmpeg";

/// Two ends of a stream. Not a pipe: writing into one whose reader is gone would end the program with a signal.
class Stream {
public:
    Stream() {
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()) != 0) {
            throw RunError("cannot make a stream to ffmpeg");
        }
    }
    ~Stream() {
        close_reading_end();
        close_writing_end();
    }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    int reading_end() const { return ends_[0]; }
    void close_reading_end() { close_end(0); }
    void close_writing_end() { close_end(1); }
    /// False where the reader is gone.
    bool write(std::span<const unsigned char> bytes) const {
        while (!bytes.empty()) {
            const ssize_t sent = send(ends_[1], bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent <= 0) return false;
            bytes = bytes.subspan(static_cast<std::size_t>(sent));
        }
        return true;
    }

private:
    void close_end(std::size_t end) {
        if (ends_[end] >= 0) close(ends_[end]);
        ends_[end] = -1;
    }

    std::array<int, 2> ends_{-1, -1};
};

std::vector<std::string> encoder_words(const FrameStyle& style, double frames_per_second, const fs::path& part) {
    return {k_encoder, "-hide_banner", "-loglevel", "error", "-xerror", "-y",
            // what comes in
            "-f", "rawvideo", "-pixel_format", "bgr0", "-video_size", fmt::format("{}x{}", style.width, style.height),
            "-framerate", fmt::format("{}", frames_per_second), "-i", "-",
            // what goes out
            "-c:v", "libx264", "-preset", "medium", "-crf", "18", "-pix_fmt", "yuv420p", "-fflags", "+bitexact",
            "-flags:v", "+bitexact", "-movflags", "+faststart", "-f", "mp4", part.string()};
}

}  // namespace

class Movie::Encoder {
public:
    Encoder(const fs::path& path, const FrameStyle& style, double frames_per_second)
        : path_(path),
          folder_(path),
          part_(folder_ / "movie.mp4"),
          log_(folder_ / "log"),
          child_(encoder_words(style, frames_per_second, part_), log_, stream_.reading_end()) {
        stream_.close_reading_end();
    }
    void write(std::span<const unsigned char> pixels) {
        if (!stream_.write(pixels)) fail();
    }
    /// The complete movie.
    const fs::path& finish() {
        stream_.close_writing_end();
        // It may end with zero although the disk is full; then it has complained.
        if (child_.wait() != 0 || fs::file_size(log_) > 0) fail();
        return part_;
    }

private:
    [[noreturn]] void fail() {
        stream_.close_writing_end();
        child_.wait();
        std::ifstream log(log_);
        const std::string said{std::istreambuf_iterator<char>(log), std::istreambuf_iterator<char>()};
        throw RunError(fmt::format("{}: ffmpeg could not write the movie: {}", path_.string(), said));
    }

    fs::path path_;
    PrivateFolder folder_;  ///< outlives the program that writes into it
    fs::path part_, log_;
    Stream stream_;
    ChildProcess child_;
};

bool can_make_movies() { return program_on_path(k_encoder); }

void require_movies(const fs::path& path) {
    require(can_make_movies(),
            "{}: a movie needs the program ffmpeg, which is not installed (Debian: apt-get install ffmpeg); or draw "
            "frames with --format png",
            path.string());
}

Movie::Movie(fs::path path, FrameStyle style, double frames_per_second)
    : path_(std::move(path)), style_(std::move(style)) {
    require_movies(path_);
    encoder_ = std::make_unique<Encoder>(path_, style_, frames_per_second);
}

Movie::~Movie() = default;

void Movie::add(const Picture& picture) {
    const Canvas canvas(style_.width, style_.height);
    paint_frame(canvas.context(), canvas.sheet(), picture, style_);
    encoder_->write(canvas.pixels());
}

void Movie::add(std::span<const NamedPicture> side_by_side) {
    const Canvas canvas(style_.width, style_.height);
    paint_side_by_side(canvas.context(), canvas.sheet(), side_by_side, style_);
    encoder_->write(canvas.pixels());
}

void Movie::finish() {
    put_in_place(encoder_->finish(), path_);
    encoder_.reset();
}

}  // namespace polargrain
