#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <charconv>
#include <memory>
#include <tuple>
#include <vector>

#include "render/frame.h"
#include "render/movie.h"
#include "scenarios/reader.h"
#include "src/cli/commands.h"
#include "src/cli/interrupt.h"
#include "src/cli/made_of_run.h"
#include "src/cli/messages.h"
#include "src/cli/recording.h"
#include "src/cli/run_folder.h"
#include "src/core/error.h"
#include "src/record/claimed_file.h"
#include "src/record/folder_lock.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_movie = "mp4";

/// How a run's own frames are drawn, as far as its folder still tells: with the wall motions that a recording does not
/// hold, so that the view and the colours are the same.
struct Drawing {
    FrameSettings settings;
    Scene scene;
};

/// "1280x720".
std::pair<int, int> parsed_size(const std::string& text) {
    int width = 0, height = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    const bool cross = first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x';
    const auto second = std::from_chars(cross ? first.ptr + 1 : end, end, height);
    const auto good = [](int pixels) { return pixels >= 16 && pixels <= 16384; };
    require(cross && second.ec == std::errc{} && second.ptr == end && good(width) && good(height),
            "--size {}: must be width and height in pixels, from 16 to 16384 each, as in 1280x720", text);
    return {width, height};
}

Drawing drawing_of(const RenderRequest& request, const TrajectoryReader& recording) {
    Drawing drawing{{}, recording.scene()};
    const fs::path file = request.folder / "scenario.toml";
    if (fs::exists(file)) {
        const Scenario scenario = load_scenario(file);
        drawing.settings = scenario.output.frames;
        require(scenario.scene.walls.size() == drawing.scene.walls.size(),
                "{}: has {} walls, trajectory.h5 has {}; they are not of the same run", file.string(),
                scenario.scene.walls.size(), drawing.scene.walls.size());
        drawing.scene.walls = scenario.scene.walls;
    }
    FrameSettings& settings = drawing.settings;
    if (!request.colour.empty()) {
        const std::string by = "by=";
        const std::string colour = request.colour.starts_with(by) ? request.colour.substr(by.size()) : request.colour;
        if (colour != settings.colour) settings.colour_max.reset();
        settings.colour = colour;
    }
    if (request.colour_max) settings.colour_max = request.colour_max;
    if (request.contacts) settings.contacts = true;
    if (!request.size.empty()) std::tie(settings.width, settings.height) = parsed_size(request.size);
    return drawing;
}

/// Of a file, without regard to case: ".mp4" of B.MP4 too.
std::string ending_of(const fs::path& place) {
    std::string ending = place.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

std::string format_of(const RenderRequest& request) {
    if (!request.format.empty()) return request.format;
    return request.out && ending_of(*request.out) == std::string(".") + k_movie ? k_movie : "png";
}

fs::path place_of(const RenderRequest& request, const std::string& format, const std::string& colour) {
    if (request.out) return *request.out;
    if (format == k_movie) return movie_in(request.folder, colour);
    return frames_in(request.folder, colour);
}

/// A name that promises another format than the one that is drawn.
void check_ending(const fs::path& place, const std::string& format) {
    constexpr std::array media{".avi", ".bmp", ".gif", ".jpeg", ".jpg", ".m4v", ".mkv",  ".mov",  ".mp4", ".mpeg",
                               ".mpg", ".ogv", ".pdf", ".png",  ".svg", ".tif", ".tiff", ".webm", ".webp"};
    const std::string ending = ending_of(place);
    const bool promises = std::ranges::find(media, ending) != media.end();
    require(!promises || (format == k_movie && ending == std::string(".") + k_movie),
            "{}: would be {} {}; give a movie a name that ends in .mp4, and frames a folder, with the --format of its "
            "files",
            place.string(), format == k_movie ? "a movie in" : "a folder of frames in", format);
}

/// Takes one picture after the other.
class Output {
public:
    virtual ~Output() = default;
    virtual void add(const Picture& picture, std::int64_t step) = 0;
    virtual void finish() = 0;
};

class MovieOutput final : public Output {
public:
    MovieOutput(const fs::path& path, bool replace, const FrameStyle& style, double rate)
        : claim_((require_movies(path), make_folder_of(path), path), replace), movie_(path, style, rate) {}
    void add(const Picture& picture, std::int64_t /*step*/) override { movie_.add(picture); }
    void finish() override { movie_.finish(); }

private:
    ClaimedFile claim_;  ///< two that draw one movie would each throw away the other's
    Movie movie_;
};

class FolderOutput final : public Output {
public:
    FolderOutput(fs::path folder, std::string format, FrameStyle style)
        : folder_(std::move(folder)),
          format_(std::move(format)),
          style_(std::move(style)),
          lock_((make_folder(folder_), folder_)),
          index_((remove_frames(folder_), folder_ / "index.csv")) {
        index_.write("file,time,step\n");
    }
    void add(const Picture& picture, std::int64_t step) override {
        const std::string file = fmt::format("{:06}.{}", count_++, format_);
        draw_frame(picture, style_, folder_ / file);
        index_.write(fmt::format("{},{},{}\n", file, picture.time, step));
    }
    void finish() override { index_.close(); }

private:
    fs::path folder_;
    std::string format_;
    FrameStyle style_;
    FolderLock lock_;  ///< two that draw into one folder would mix their frames
    TextFile index_;
    int count_ = 0;
};

std::unique_ptr<Output> open_output(const RenderRequest& request, const fs::path& place, const std::string& format,
                                    const FrameStyle& style) {
    check_ending(place, format);
    if (format == k_movie) {
        check_run_stays(request.folder, place);
        require(!fs::is_directory(place), "{}: is a folder; give the name of a movie with -o", place.string());
        return std::make_unique<MovieOutput>(place, request.force, style, request.frames_per_second);
    }
    const bool filled = fs::is_directory(place) ? !fs::is_empty(place) : fs::exists(place);
    require(request.force || !filled, "{}: is there already; give another name with -o, or --force to replace it",
            place.string());
    require(!fs::exists(place) || fs::is_directory(place), "{}: is a file; give a folder for the frames with -o",
            place.string());
    return std::make_unique<FolderOutput>(place, format, style);
}

}  // namespace

int render_command(const RenderRequest& request) {
    const TrajectoryReader recording = open_recording(request.folder);
    const Drawing drawing = drawing_of(request, recording);
    const FrameStyle style =
        make_frame_style(drawing.settings, drawing.scene, recording.title(), recording.time_step());
    const std::vector<int> frames = chosen_frames(request.frames, recording, request.folder);
    const std::string format = format_of(request);
    const fs::path place = place_of(request, format, drawing.settings.colour);
    const std::atomic<bool>& stop = watch_interrupts();
    const std::unique_ptr<Output> output = open_output(request, place, format, style);
    const auto draw = [&](const StoredFrame& frame) {
        output->add(picture_of(recording.scene(), frame), frame.world.step);
    };
    bool done = false;
    try {
        done = for_each_frame(recording, frames, "drawing", request.quiet, draw, &stop);
        if (done) output->finish();
    } catch (const RunError&) {
        if (!stop) throw;
        done = false;  // Ctrl-C has ended ffmpeg too
    }
    if (!done) {
        tell("interrupted; {}: {}\n", place.string(), format == k_movie ? "not written" : "has the first frames alone");
        return k_exit_interrupted;
    }
    if (!request.quiet) fmt::print("{} frames: {}\n", frames.size(), place.string());
    return k_exit_done;
}

}  // namespace polargrain
