#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "src/core/child_process.h"
#include "src/core/error.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;

fs::path log_file(const char* name) { return fs::path(::testing::TempDir()) / name; }

std::string first_line(const fs::path& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

TEST(ChildProcess, RunsWithItsWordsAndKeepsWhatItPrints) {
    const fs::path log = log_file("child-echo.log");
    EXPECT_EQ(ChildProcess({"echo", "two words", "*"}, log).wait(), 0);
    EXPECT_EQ(first_line(log), "two words *");
}

TEST(ChildProcess, KeepsErrorOutputToo) {
    const fs::path log = log_file("child-error.log");
    EXPECT_EQ(ChildProcess({"sh", "-c", "echo wrong >&2; exit 3"}, log).wait(), 3);
    EXPECT_EQ(first_line(log), "wrong");
}

TEST(ChildProcess, TellsOfASignalAs128AndItsNumber) {
    EXPECT_EQ(ChildProcess({"sh", "-c", "kill -TERM $$"}, log_file("child-term.log")).wait(), 128 + 15);
}

TEST(ChildProcess, IsStillThereUntilItEnds) {
    ChildProcess child({"sleep", "30"}, log_file("child-sleep.log"));
    EXPECT_FALSE(child.poll());
    child.interrupt(SIGINT);
    EXPECT_EQ(child.wait(), 128 + 2);
    EXPECT_EQ(child.poll(), 128 + 2);
}

TEST(ChildProcess, EndsWithItsOwner) {
    const auto start = std::chrono::steady_clock::now();
    { const ChildProcess child({"sleep", "30"}, log_file("child-owner.log")); }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(ChildProcess, NamesAProgramThatIsNotThere) {
    EXPECT_THROW(ChildProcess({"no-such-program-anywhere"}, log_file("child-none.log")), RunError);
    EXPECT_FALSE(program_on_path("no-such-program-anywhere"));
    EXPECT_TRUE(program_on_path("sh"));
}

}  // namespace
}  // namespace polargrain
