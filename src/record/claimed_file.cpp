#include "src/record/claimed_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

ClaimedFile::ClaimedFile(const std::filesystem::path& path, bool replace)
    : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)), made_(file_ >= 0) {
    if (!made_ && errno == EEXIST) file_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file_ < 0) {
        throw RunError(fmt::format("{}: cannot create the file: {}; give another name with -o", path.string(),
                                   std::generic_category().message(errno)));
    }
    try {
        claim(replace);
    } catch (const InputError&) {
        close(file_);
        throw;
    }
}

void ClaimedFile::claim(bool replace) const {
    require(flock(file_, LOCK_EX | LOCK_NB) == 0,
            "{}: another polargrain is writing this file; wait for it, or give another name with -o", path_.string());
    require(made_ || replace, "{}: is there already; give another name with -o, or --force to replace it",
            path_.string());
}

ClaimedFile::~ClaimedFile() {
    struct stat mine = {}, there = {};
    // What has been put in its place meanwhile is another file.
    const bool still_mine = made_ && fstat(file_, &mine) == 0 && stat(path_.c_str(), &there) == 0 &&
                            mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
    if (still_mine && there.st_size == 0) unlink(path_.c_str());
    close(file_);
}

}  // namespace polargrain
