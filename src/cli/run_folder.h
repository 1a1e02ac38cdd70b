#pragma once

#include <filesystem>

#include "src/record/folder_lock.h"

namespace polargrain {

/// Throws InputError where the folder cannot become a run folder: it is a file, or something is in it and `force` is
/// not set. Changes nothing.
void check_run_folder(const std::filesystem::path& folder, bool force);

/// Makes the folder and its parents and keeps it for this program; what is in it stays. InputError where it cannot
/// become a run folder, as check_run_folder, or another program holds it; RunError where it cannot be made or written.
FolderLock claim_run_folder(const std::filesystem::path& folder, bool force);

/// Removes what an earlier run left in the folder: only files that a run folder is made of, nothing else. RunError
/// where that fails. Another program that runs in the folder would lose its files: take a FolderLock first.
void clear_run_folder(const std::filesystem::path& folder);

/// Removes the folder if there is nothing in it.
void remove_if_empty(const std::filesystem::path& folder);

/// Removes drawn frames and their index.csv from a folder, nothing else.
void remove_frames(const std::filesystem::path& frames);

/// Removes the files of a run from the folder, and the folder if it is empty then. Take a FolderLock first.
void discard_run_folder(const std::filesystem::path& folder);

}  // namespace polargrain
