#include "src/core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// Where the three standard streams of a child go.
class Redirections {
public:
    Redirections(const fs::path& log, int input) {
        posix_spawn_file_actions_init(&actions_);
        if (input >= 0) {
            posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
        } else {
            posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        }
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    }
    ~Redirections() { posix_spawn_file_actions_destroy(&actions_); }
    Redirections(const Redirections&) = delete;
    Redirections& operator=(const Redirections&) = delete;
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const fs::path& log, int input) {
    std::vector<std::string> copies = words;
    std::vector<char*> arguments;
    arguments.reserve(copies.size() + 1);
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const Redirections redirections(log, input);
    const int failure = posix_spawnp(&pid_, arguments[0], redirections.get(), nullptr, arguments.data(), environ);
    if (failure == 0) return;
    pid_ = -1;
    throw RunError(fmt::format("cannot start {} (its output would go to {}): {}", words[0], log.string(),
                               std::generic_category().message(failure)));
}

ChildProcess::~ChildProcess() {
    if (pid_ < 0 || poll()) return;
    kill(pid_, SIGKILL);
    wait();
}

std::optional<int> ChildProcess::poll() { return exit_code_ ? exit_code_ : collect(WNOHANG); }

int ChildProcess::wait() {
    while (!exit_code_) collect(0);
    return *exit_code_;
}

void ChildProcess::interrupt(int signal) const {
    if (!exit_code_) kill(pid_, signal);
}

std::optional<int> ChildProcess::collect(int options) {
    int status = 0;
    const pid_t ended = waitpid(pid_, &status, options);
    if (ended == pid_) {
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    } else if (ended < 0 && errno != EINTR) {
        exit_code_ = EXIT_FAILURE;
    }
    return exit_code_;
}

bool program_on_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::string_view left = path != nullptr ? path : "";
    while (!left.empty()) {
        const std::size_t colon = left.find(':');
        const fs::path candidate = fs::path(left.substr(0, colon)) / name;
        if (access(candidate.c_str(), X_OK) == 0) return true;
        left = colon == std::string_view::npos ? "" : left.substr(colon + 1);
    }
    return false;
}

}  // namespace polargrain
