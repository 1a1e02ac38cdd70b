#include "src/core/trial.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include "src/core/error.h"

namespace polargrain {

namespace {

[[noreturn]] void be_the_copy(const std::function<void()>& job, unsigned seconds) {
    constexpr std::array crashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU};
    for (const int signal : crashes) std::signal(signal, SIG_DFL);
    const rlimit no_core{0, 0}, time{seconds, seconds};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_CPU, &time);
    // Libraries complain of what they find broken, and the message for the user comes from elsewhere.
    if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    try {
        job();
    } catch (...) {  // NOLINT(bugprone-empty-catch): it will be thrown again where it can be told
    }
    _exit(EXIT_SUCCESS);
}

}  // namespace

Trial try_out(const std::function<void()>& job, unsigned seconds) {
    const pid_t copy = fork();
    if (copy < 0) throw RunError("cannot start a process: " + std::generic_category().message(errno));
    if (copy == 0) be_the_copy(job, seconds);
    int status = 0;
    while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) return Trial::passed;
    const bool out_of_time = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    return out_of_time ? Trial::too_long : Trial::crashed;
}

}  // namespace polargrain
