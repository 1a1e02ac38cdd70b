#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <initializer_list>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

using testing::HasSubstr;

constexpr const char* k_erase_line = "\r\x1b[K";

/// All that the program writes to a terminal with so many columns.
std::string on_terminal(std::vector<std::string> words, const std::filesystem::path& folder, unsigned short columns) {
    words.insert(words.begin(), POLARGRAIN_BINARY_DIR "/polargrain");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    EXPECT_TRUE(terminal >= 0 && grantpt(terminal) == 0 && unlockpt(terminal) == 0);
    ioctl(terminal, TIOCSWINSZ, &size);
    const std::string name = ptsname(terminal);
    const pid_t process = fork();
    if (process == 0) {
        const int end = open(name.c_str(), O_RDWR | O_NOCTTY);
        const bool ready = dup2(end, STDOUT_FILENO) >= 0 && dup2(end, STDERR_FILENO) >= 0;
        close(terminal);
        close(end);
        if (ready && chdir(folder.c_str()) == 0) execv(argv[0], argv.data());
        _exit(127);
    }
    std::string text;
    char block[4096];
    for (ssize_t n = 0; (n = read(terminal, block, sizeof block)) > 0;) text.append(block, static_cast<std::size_t>(n));
    close(terminal);
    int status = 0;
    waitpid(process, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text;
    return text;
}

TEST(Terminal, ProgressFitsIntoOneLineAndIsGoneBeforeAnythingElseIsSaid) {
    const ScratchFolder scratch;
    scratch.write("long.toml", k_three_disks + "[settle]\nat_most = 6.0\n");
    for (const unsigned short columns : std::initializer_list<unsigned short>{30, 80, 200}) {
        const std::string text = on_terminal({"run", "long.toml", "-o", "long", "--force"}, scratch.path(), columns);
        std::size_t bars = 0;
        for (std::size_t at = 0; (at = text.find("settling [", at)) != std::string::npos; ++at, ++bars) {
            EXPECT_LT(text.find('\r', at) - at, columns) << text;
        }
        EXPECT_GT(bars, 0U) << text;
        EXPECT_THAT(text, HasSubstr(std::string(k_erase_line) + "settling: not yet at rest"));
    }
}

}  // namespace
}  // namespace polargrain
