#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/cli/commands.h"
#include "src/record/trajectory_reader.h"

namespace polargrain {

/// InputError where there is no such folder.
void require_run_folder(const std::filesystem::path& folder);

/// The trajectory.h5 of a run folder. InputError where there is none, it is damaged or without a
/// frame, or the run is in progress.
TrajectoryReader open_recording(const std::filesystem::path& folder);

/// Numbers of the frames that are asked for; InputError where there is none. folder: of the recording, for messages.
std::vector<int> chosen_frames(const FrameChoice& choice, const TrajectoryReader& recording,
                               const std::filesystem::path& folder);

/// Hands one frame after the other to the job, until `stop` is set: false then. Unless quiet, shows how far it has
/// come; label: what the job does.
bool for_each_frame(const TrajectoryReader& recording, const std::vector<int>& frames, const std::string& label,
                    bool quiet, const std::function<void(const StoredFrame&)>& job,
                    const std::atomic<bool>* stop = nullptr);

}  // namespace polargrain
