#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace polargrain {

/// Another program, running beside this one.
///
/// It reads nothing unless an input is given, and whatever it prints goes to a file. Destroying the object ends a
/// program that still runs.
class ChildProcess {
public:
    /// words: the program (a path, or a name to be looked for on PATH) and its arguments. log: file for what it
    /// prints. input: open file that it reads, none where negative. RunError where it cannot be started.
    ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& log, int input = -1);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Its exit code once it has ended (128 + signal where a signal ended it); none while it runs. Does not wait.
    std::optional<int> poll();
    /// Waits for its end.
    int wait();
    /// Asks it to end by a signal.
    void interrupt(int signal) const;

private:
    std::optional<int> collect(int options);

    pid_t pid_ = -1;
    std::optional<int> exit_code_;
};

/// True where a program of that name is on PATH.
bool program_on_path(const std::string& name);

}  // namespace polargrain
