#include "src/cli/run_folder.h"

#include <array>
#include <string>

#include "scenarios/reader.h"
#include "src/cli/made_of_run.h"
#include "src/core/error.h"
#include "src/record/checkpoint_file.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// The scenario goes first: without it nothing is taken for a run that could be carried on while the rest goes. The
/// checkpoint goes last: by it the rest is known to be of a run.
constexpr std::array k_run_files{"scenario.toml",      "scenario.toml.part", "summary.json",  "summary.json.part",
                                 "series.csv",         "impacts.csv",        "trajectory.h5", "trajectory.h5.part",
                                 "checkpoint.h5.part", "checkpoint.h5"};

/// What a run would replace in the folder; nothing where it would replace nothing.
std::string first_replaced(const fs::path& folder) {
    for (const char* name : k_run_files) {
        const fs::path file = folder / name;
        if (file.extension() != ".part" && fs::exists(fs::symlink_status(file))) return name;
    }
    return holds_frames(folder / "frames") ? "frames" : "";
}

/// A folder where a file of the run is to stand is found before anything is removed, not afterwards.
void require_no_folders(const fs::path& folder) {
    for (const char* name : k_run_files) {
        const fs::path file = folder / name;
        require(!fs::is_directory(file), "{}: is a folder, where a run puts a file; move it away, or give another -o",
                file.string());
    }
    const fs::path frames = folder / "frames";
    require(!fs::exists(frames) || fs::is_directory(frames),
            "{}: is a file, where a run puts a folder; move it away, or give another -o", frames.string());
}

void remove_run_files(const fs::path& folder) {
    for (const char* name : k_run_files) remove_file(folder / name);
    const fs::path frames = folder / "frames";
    if (!fs::is_directory(frames)) return;
    remove_frames(frames);
    remove_if_empty(frames);
}

}  // namespace

bool holds_run(const fs::path& folder) {
    return is_resolved_scenario(folder / "scenario.toml") || is_checkpoint(folder / "checkpoint.h5");
}

void check_run_folder(const fs::path& folder, bool force) {
    check_place(folder);
    if (!fs::exists(folder) || fs::is_empty(folder)) return;
    if (holds_run(folder)) {
        require(force, "{}: there is a run in the folder; give another with -o, or --force to replace that run",
                folder.string());
        return;
    }
    const std::string replaced = first_replaced(folder);
    require(replaced.empty(),
            "{}: there is no run in the folder, but {}, which a run would replace; give another folder with -o",
            folder.string(), replaced);
    require(force, "{}: the folder is not empty; give another with -o, or --force to put the run beside what is in it",
            folder.string());
}

void check_scenario_stays(const fs::path& folder, const fs::path& scenario, const std::string& resolved) {
    for (const char* name : k_run_files) {
        std::error_code absent;
        if (!fs::equivalent(folder / name, scenario, absent)) continue;
        require(content_of(scenario) == resolved,
                "{}: is the scenario that is read, and a run in its folder would replace it; give another folder with "
                "-o",
                scenario.string());
    }
}

void check_run_stays(const fs::path& folder, const fs::path& file) {
    for (const char* name : k_run_files) {
        std::error_code absent;
        require(!fs::equivalent(folder / name, file, absent),
                "{}: is a file of the run itself, which is never replaced; give another name with -o", file.string());
    }
}

FolderLock claim_folder(const fs::path& folder, const std::function<void()>& check) {
    check();
    make_folder(folder);
    FolderLock lock(folder);
    check();  // another program may have begun and ended in it by now
    return lock;
}

void clear_run_folder(const fs::path& folder) {
    if (!holds_run(folder)) return;
    require_no_folders(folder);
    try {
        remove_run_files(folder);
        remove_made_of_run(folder);
    } catch (const fs::filesystem_error& error) {
        const fs::path& entry = error.path1().empty() ? folder : error.path1();
        throw RunError(fmt::format(
            "{}: cannot be removed, so the run folder {} is not empty: {}; remove it yourself, or give another -o",
            entry.string(), folder.string(), error.code().message()));
    }
}

void discard_run_folder(const fs::path& folder) {
    remove_run_files(folder);
    remove_if_empty(folder);
}

}  // namespace polargrain
