#include "src/record/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "src/core/error.h"

namespace polargrain {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    require(folder_ >= 0, "{}: no such run folder", folder.string());
    if (flock(folder_, LOCK_EX | LOCK_NB) == 0) return;
    close(folder_);
    throw InputError(
        fmt::format("{}: another polargrain is running in this folder; wait for it, or stop it", folder.string()));
}

bool FolderLock::is_free(const std::filesystem::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return true;
    const bool free = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    close(descriptor);
    return free;
}

void FolderLock::require_finished(const std::filesystem::path& folder) {
    require(is_free(folder),
            "{0}: the run in this folder is in progress, and its trajectory.h5 is being written; wait for its end, or "
            "stop it with Ctrl-C and carry it on later: polargrain resume {0}",
            folder.string());
}

FolderLock::~FolderLock() {
    if (folder_ >= 0) close(folder_);
}

}  // namespace polargrain
