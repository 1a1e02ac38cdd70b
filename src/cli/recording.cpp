#include "src/cli/recording.h"

#include <fmt/format.h>

#include "src/cli/progress_display.h"
#include "src/core/error.h"
#include "src/record/folder_lock.h"
#include "src/run/progress.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

fs::path trajectory_of(const fs::path& folder) { return folder / "trajectory.h5"; }

}  // namespace

void require_run_folder(const fs::path& folder) {
    require(fs::is_directory(folder), "{}: no such run folder; give the folder that polargrain run has made",
            folder.string());
}

TrajectoryReader open_recording(const fs::path& folder) {
    require_run_folder(folder);
    FolderLock::require_finished(folder);
    TrajectoryReader recording(trajectory_of(folder));
    require(recording.frames() > 0, "{}: holds no frame yet; carry the run on: polargrain resume {}",
            trajectory_of(folder).string(), folder.string());
    return recording;
}

std::vector<int> chosen_frames(const FrameChoice& choice, const TrajectoryReader& recording, const fs::path& folder) {
    std::vector<int> chosen;
    // A frame is stored at the first step at or after its time.
    const double late = recording.time_step();
    for (int f = 0; f < recording.frames(); ++f) {
        const double time = recording.time(f);
        if (time >= choice.from && time < choice.to + late) chosen.push_back(f);
    }
    require(!chosen.empty(), "--from {} --to {}: no frame of {} is in between; they go from {} s to {} s", choice.from,
            choice.to, trajectory_of(folder).string(), recording.time(0), recording.time(recording.frames() - 1));
    std::vector<int> thinned;
    for (std::size_t k = 0; k < chosen.size(); k += static_cast<std::size_t>(choice.every)) {
        thinned.push_back(chosen[k]);
    }
    return thinned;
}

bool for_each_frame(const TrajectoryReader& recording, const std::vector<int>& frames, const std::string& label,
                    bool quiet, const std::function<void(const StoredFrame&)>& job, const std::atomic<bool>* stop) {
    ProgressDisplay display(label, display_mode(quiet), "frames");
    const LoopControl control{.stop = stop,
                              .progress = [&display](const Progress& progress) { display.show(progress); }};
    ProgressMeter meter(control, 0, static_cast<std::int64_t>(frames.size()), 1.0);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (control.stop_requested()) return false;
        job(recording.frame(frames[k]));
        meter.after_step(static_cast<std::int64_t>(k + 1));
    }
    return true;
}

}  // namespace polargrain
