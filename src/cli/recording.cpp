#include "src/cli/recording.h"

#include <fmt/format.h>

#include "src/cli/progress_display.h"
#include "src/core/error.h"
#include "src/record/folder_lock.h"
#include "src/record/sample_range.h"
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
    std::vector<double> times;
    for (int f = 0; f < recording.frames(); ++f) times.push_back(recording.time(f));
    const SampleRange range = samples_between(times, choice.from, choice.to, recording.time_step());
    require(range.first < range.last, "--from {} --to {}: no frame of {} is in between; they go from {} s to {} s",
            choice.from, choice.to, trajectory_of(folder).string(), times.front(), times.back());
    std::vector<int> chosen;
    for (std::size_t f = range.first; f < range.last; f += static_cast<std::size_t>(choice.every)) {
        chosen.push_back(static_cast<int>(f));
    }
    return chosen;
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
