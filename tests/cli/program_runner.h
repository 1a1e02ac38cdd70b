#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace polargrain {

/// A new empty folder under the system's temporary one, removed with everything in it at the end.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Writes a file into it and returns its path.
    std::filesystem::path write(const std::string& name, const std::string& text) const;

private:
    std::filesystem::path path_;
};

/// What the program left behind when it ended.
struct Outcome {
    int exit_code = -1;  ///< negative: ended by that signal
    std::string out, err;
};

/// The built program, started in a folder and a process group of its own, without a terminal.
class RunningProgram {
public:
    /// largest_file: bytes beyond which none of its files can grow, as on a full disk.
    RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   std::optional<rlim_t> largest_file = std::nullopt);
    void send(int signal) const;
    /// To all that it has started too, as Ctrl-C in a terminal does.
    void send_to_all(int signal) const;
    /// Waits for its end; may be called once.
    Outcome wait();

private:
    ScratchFolder captured_;
    pid_t process_;
};

inline Outcome run_polargrain(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    return RunningProgram(arguments, folder).wait();
}

std::string read_file(const std::filesystem::path& path);

/// Waits until something of that name is there; a minute at most. False where it has not come.
bool wait_for(const std::filesystem::path& path);

}  // namespace polargrain
