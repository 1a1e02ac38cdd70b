#pragma once

#include <filesystem>
#include <utility>

namespace polargrain {

/// Keeps a folder for this program as long as it lives, and no longer however it ends: a lock of the system, no file.
class FolderLock {
public:
    /// InputError where another program holds it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    FolderLock(FolderLock&& other) noexcept : folder_(std::exchange(other.folder_, -1)) {}
    FolderLock& operator=(FolderLock&&) = delete;

    /// Whether no program holds it just now.
    static bool is_free(const std::filesystem::path& folder);
    /// InputError where one does, and its trajectory is not to be read yet therefore.
    static void require_finished(const std::filesystem::path& folder);

private:
    int folder_;  ///< open; below zero: handed on
};

}  // namespace polargrain
