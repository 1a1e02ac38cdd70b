#include "src/cli/run_folder.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "src/core/error.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// The scenario first: without it nothing is taken for a run that could be carried on while the rest goes.
constexpr std::array k_run_files{"scenario.toml",      "scenario.toml.part", "checkpoint.h5", "checkpoint.h5.part",
                                 "summary.json",       "summary.json.part",  "series.csv",    "trajectory.h5",
                                 "trajectory.h5.part", "impacts.csv",        "sheet.png"};

bool belongs_to_frames(const fs::path& file) {
    constexpr std::array extensions{".png", ".svg", ".pdf"};
    if (file.filename() == "index.csv") return true;
    const std::string stem = file.stem().string();
    return !stem.empty() && std::ranges::all_of(stem, [](char c) { return c >= '0' && c <= '9'; }) &&
           std::ranges::find(extensions, file.extension().string()) != extensions.end();
}

void remove_run_files(const fs::path& folder) {
    for (const char* name : k_run_files) fs::remove(folder / name);
    const fs::path frames = folder / "frames";
    if (!fs::is_directory(frames)) return;
    remove_frames(frames);
    remove_if_empty(frames);
}

}  // namespace

// Refuses by itself where something is in it; a link to a folder is left alone too.
void remove_if_empty(const fs::path& folder) { rmdir(folder.c_str()); }

void remove_frames(const fs::path& frames) {
    std::vector<fs::path> drawn;
    for (const fs::directory_entry& entry : fs::directory_iterator(frames)) {
        if (belongs_to_frames(entry.path())) drawn.push_back(entry.path());
    }
    for (const fs::path& file : drawn) fs::remove(file);
}

void check_run_folder(const fs::path& folder, bool force) {
    if (!fs::exists(folder)) return;
    require(fs::is_directory(folder), "{}: is a file; give another folder with -o", folder.string());
    require(force || fs::is_empty(folder),
            "{}: the folder is not empty; give another with -o, or --force to replace the run in it", folder.string());
}

FolderLock claim_run_folder(const fs::path& folder, bool force) {
    check_run_folder(folder, force);
    make_folder(folder);
    FolderLock lock(folder);
    check_run_folder(folder, force);  // another run may have begun and ended in it by now
    return lock;
}

void clear_run_folder(const fs::path& folder) {
    try {
        remove_run_files(folder);
    } catch (const fs::filesystem_error& error) {
        throw RunError(fmt::format("cannot empty the run folder {}: {}", folder.string(), error.code().message()));
    }
}

void discard_run_folder(const fs::path& folder) {
    remove_run_files(folder);
    remove_if_empty(folder);
}

}  // namespace polargrain
