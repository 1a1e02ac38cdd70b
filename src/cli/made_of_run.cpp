#include "src/cli/made_of_run.h"

#include <algorithm>
#include <array>
#include <vector>

#include "render/frame_style.h"
#include "src/export/grains_csv.h"
#include "src/export/vtk_export.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

bool is_of_frames(const fs::path& file) {
    constexpr std::array endings{".png", ".svg", ".pdf"};
    if (file.filename() == "index.csv") return true;
    const std::string stem = file.stem().string();
    return !stem.empty() && std::ranges::all_of(stem, [](char c) { return c >= '0' && c <= '9'; }) &&
           std::ranges::find(endings, file.extension().string()) != endings.end();
}

std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
    return entries;
}

fs::path with_ending(const fs::path& stem, const char* ending) { return stem.string() + ending; }

/// A plot is made of all three; one alone is somebody's own.
void remove_plot(const fs::path& stem) {
    const auto exists = [&](const char* ending) { return fs::is_regular_file(with_ending(stem, ending)); };
    if (!std::ranges::all_of(k_plot_endings, exists)) return;
    for (const char* ending : k_plot_endings) remove_file(with_ending(stem, ending));
}

void remove_export(const fs::path& folder) {
    if (!fs::is_directory(folder)) return;
    VtkExport::remove(folder);
    GrainsCsv::remove(folder);
    remove_if_empty(folder);
}

}  // namespace

fs::path sheet_in(const fs::path& folder) { return folder / "sheet.png"; }

fs::path export_in(const fs::path& folder) { return folder / "export"; }

fs::path frames_in(const fs::path& folder, const std::string& colour) { return folder / ("frames-" + colour); }

fs::path movie_in(const fs::path& folder, const std::string& colour) { return folder / ("movie-" + colour + ".mp4"); }

fs::path plot_in(const fs::path& folder) { return folder / "plot"; }

void remove_made_of_run(const fs::path& folder) {
    remove_file(sheet_in(folder));
    remove_plot(plot_in(folder));
    remove_export(export_in(folder));
    // movie-of-my-own.mp4 is somebody's own.
    for (const std::string& colour : colour_names()) {
        remove_file(movie_in(folder, colour));
        const fs::path frames = frames_in(folder, colour);
        if (!fs::is_directory(frames)) continue;
        remove_frames(frames);
        remove_if_empty(frames);
    }
}

void remove_frames(const fs::path& frames) {
    for (const fs::path& file : entries_of(frames)) {
        if (is_of_frames(file)) remove_file(file);
    }
}

bool holds_frames(const fs::path& frames) {
    return fs::is_directory(frames) && std::ranges::any_of(entries_of(frames), is_of_frames);
}

}  // namespace polargrain
