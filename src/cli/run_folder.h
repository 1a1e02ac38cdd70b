#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "src/record/folder_lock.h"

namespace polargrain {

/// Whether a run has left its files in the folder: its resolved scenario or a checkpoint, which nothing else makes.
bool holds_run(const std::filesystem::path& folder);

/// Throws InputError where the folder cannot become a run folder: there can be none (check_place), or something is in
/// it and `force` is not set, or, with `force`, files of these names would be replaced though there is no run in it.
/// Changes nothing.
void check_run_folder(const std::filesystem::path& folder, bool force);

/// InputError where a run into the folder would replace the scenario file that it is read from by another text than
/// `resolved`, the one that it writes.
void check_scenario_stays(const std::filesystem::path& folder, const std::filesystem::path& scenario,
                          const std::string& resolved);

/// InputError where the file, which is to be replaced, is one that the run in the folder is made of.
void check_run_stays(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Makes the folder and its parents and keeps it for this program; what is in it stays. InputError where `check`, which
/// is to look whether it can be taken, throws it, or another program holds it; RunError where it cannot be made or
/// written.
FolderLock claim_folder(const std::filesystem::path& folder, const std::function<void()>& check);

/// Removes what an earlier run left in the folder, and what was drawn or tabulated of it there (remove_made_of_run):
/// only files that these are made of, nothing else, and nothing at all where there is no run in it. InputError, with
/// nothing removed, where a folder stands under the name of a file of a run; RunError where removing fails. Another
/// program that runs in the folder would lose its files: take a FolderLock first.
void clear_run_folder(const std::filesystem::path& folder);

/// Removes the files of a run that has begun from the folder, and the folder if it is empty then. Take a FolderLock
/// first.
void discard_run_folder(const std::filesystem::path& folder);

}  // namespace polargrain
