#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <string>

namespace polargrain::testing {

/// How long each file was when this program last waited until it was on the disk; folders have their number of names.
inline std::map<std::string, std::uintmax_t>& synced_files() {
    static std::map<std::string, std::uintmax_t> lengths;
    return lengths;
}

/// Whether the file, as it is now, has been waited for.
inline bool is_on_disk(const std::filesystem::path& path) {
    const auto found = synced_files().find(path.string());
    return found != synced_files().end() && found->second == std::filesystem::file_size(path);
}

}  // namespace polargrain::testing

/// In place of the system's: notes the file. To be included by one file of a test program.
extern "C" int fsync(int descriptor) {
    namespace fs = std::filesystem;
    const fs::path path = fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor));
    polargrain::testing::synced_files()[path.string()] =
        fs::is_directory(path) ? static_cast<std::uintmax_t>(std::distance(fs::directory_iterator(path), {}))
                               : fs::file_size(path);
    return static_cast<int>(syscall(SYS_fsync, descriptor));
}
