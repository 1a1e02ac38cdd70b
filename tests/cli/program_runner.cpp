#include "tests/cli/program_runner.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace polargrain {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "polargrain-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + pattern);
    path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path ScratchFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
}

std::string read_file(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

bool wait_for(const fs::path& path) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!fs::exists(path) && std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return fs::exists(path);
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const fs::path& folder,
                               std::optional<rlim_t> largest_file) {
    const std::string program = POLARGRAIN_BINARY_DIR "/polargrain";
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = captured_ / "out", err = captured_ / "err";

    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot start " + program);
    setpgid(process_, process_);  // by both, as either may come first
    if (process_ > 0) return;
    constexpr int k_no_program = 127;
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    if (dup2(open(out.c_str(), flags, 0600), STDOUT_FILENO) < 0) _exit(k_no_program);
    if (dup2(open(err.c_str(), flags, 0600), STDERR_FILENO) < 0) _exit(k_no_program);
    const rlimit limit{largest_file.value_or(RLIM_INFINITY), RLIM_INFINITY};
    if (largest_file && setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(k_no_program);
    if (chdir(folder.c_str()) != 0) _exit(k_no_program);
    execv(program.c_str(), argv.data());
    _exit(k_no_program);
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

void RunningProgram::send_to_all(int signal) const { kill(-process_, signal); }

Outcome RunningProgram::wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {code, read_file(captured_ / "out"), read_file(captured_ / "err")};
}

}  // namespace polargrain
