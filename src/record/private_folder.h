#pragma once

#include <filesystem>

namespace polargrain {

/// A folder beside a file that is being made, for what there is only meanwhile: with a name that nothing had before, so
/// that nothing of the user's is overwritten, nor of another program that makes the same file. Removed with all that is
/// in it.
class PrivateFolder {
public:
    /// Beside `path`, with its name and more. RunError where it cannot be made.
    explicit PrivateFolder(const std::filesystem::path& path);
    ~PrivateFolder();
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;

    std::filesystem::path operator/(const char* name) const { return path_ / name; }
    /// Leaves it there for the user to look into.
    void keep() { kept_ = true; }

private:
    std::filesystem::path path_;
    bool kept_ = false;
};

}  // namespace polargrain
