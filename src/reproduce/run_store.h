#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "src/reproduce/piece.h"

namespace polargrain {

/// Tells how far the pieces are. done and all count pieces; seconds_left is an estimate from those that are done.
struct StoreProgress {
    std::size_t done = 0, all = 0;
    std::string last;  ///< name of the piece that has just ended; empty at the start
    double seconds_left = 0.0;
};

/// Run folders of pieces, kept under names that hold their keys: whatever was finished is never computed again.
///
/// Each missing piece is run by a program of its own (`polargrain run`), into a folder that takes its final name when
/// all is there. A kill at any instant loses no more than the pieces in progress.
class RunStore {
public:
    /// program: the polargrain program. The folder is made when the first piece is run.
    RunStore(std::filesystem::path folder, std::filesystem::path program, const std::vector<EngineAtHand>& engines);

    /// Where the run folder of a piece is, or will be.
    std::filesystem::path folder_of(const Piece& piece) const;
    bool finished(const Piece& piece) const;

    /// Runs the pieces that are not there yet, `jobs` at a time. Returns false where `stop` ended it early.
    /// RunError with the output of a piece that fails.
    bool complete(const std::vector<Piece>& pieces, int jobs, const std::atomic<bool>& stop,
                  const std::function<void(const StoreProgress&)>& show) const;

private:
    std::filesystem::path folder_, program_;
    std::map<std::string, std::string> fingerprints_;  // by engine
};

}  // namespace polargrain
