#pragma once

#include <filesystem>
#include <string>

#include "src/cli/prepared_run.h"
#include "src/record/checkpoint_file.h"
#include "src/record/folder_lock.h"

namespace polargrain {

/// Where a run goes, and how it is told of.
struct RunSession {
    std::filesystem::path folder;
    std::string program = "polargrain";  ///< as it was called, for messages that say how to go on
    bool quiet = false;
    bool brief = false;             ///< show progress, but no summary
    std::string opening_line = {};  ///< said when nothing can refuse the run any more; empty: nothing
    std::string repeat_line = {};   ///< command that does all of it again, where resuming would not do; empty: it will

    std::filesystem::path scenario_file() const { return folder / "scenario.toml"; }
    std::filesystem::path checkpoint_file() const { return folder / "checkpoint.h5"; }
    /// How to go on after an interruption: a phrase and the command.
    std::string way_on() const;
};

/// Fingerprint of a resolved scenario, whatever its duration: that may change between a run and its continuation.
std::string scenario_fingerprint(const std::string& resolved_toml);

/// Time that a checkpoint has reached [s]; below zero while the grains settle.
double time_reached(const LabelledCheckpoint& saved);

/// Runs in the folder to the end: settling, the loop with its outputs and checkpoints, the summary. Where `saved` is
/// not null, from that checkpoint on, with every later bit as if there had been no interruption.
///
/// lock: on the folder. Returns the exit code, k_exit_interrupted after a signal; messages have been printed then.
/// Writes scenario.toml. InputError where checkpoint, scenario and files do not belong together; nothing has been
/// changed then. RunError where the run cannot go on; the last checkpoint stays.
int run_session(const RunSession& session, const FolderLock& lock, PreparedRun& run,
                const LabelledCheckpoint* saved = nullptr);

}  // namespace polargrain
