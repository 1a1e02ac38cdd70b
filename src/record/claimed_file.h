#pragma once

#include <filesystem>

namespace polargrain {

/// Keeps the name of a file that is to be put there later (put_in_place) for this program. Meanwhile an empty file of
/// that name stands there where there was none, and goes again where nothing comes of it.
class ClaimedFile {
public:
    /// InputError where another program has claimed it, or it is there already and is not to be replaced; RunError
    /// where it cannot be made.
    ClaimedFile(const std::filesystem::path& path, bool replace);
    ~ClaimedFile();
    ClaimedFile(const ClaimedFile&) = delete;
    ClaimedFile& operator=(const ClaimedFile&) = delete;

private:
    void claim(bool replace) const;

    std::filesystem::path path_;
    int file_ = -1;  ///< open, and locked
    bool made_ = false;
};

}  // namespace polargrain
