#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Compare, LeavesAReportTablesPlotsAndFramesSideBySide) {
    const ScratchFolder scratch;
    scratch.write("disks.toml",
                  replaced(k_three_disks, "frames = { every = 0.0 }", "frames = { every = 0.025, width = 320 }"));
    const Outcome outcome = run_polargrain(
        {"compare", "disks.toml", "--engines", "contact,box2d", "--seeds", "2", "-o", "both"}, scratch.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string report = read_file(scratch / "both/report.md");
    EXPECT_THAT(outcome.out, HasSubstr(report));
    EXPECT_THAT(report, HasSubstr("2 engines on the same initial states, bit for bit, over 2 seeds"));
    EXPECT_THAT(report, HasSubstr("The scene does not depend on the seed"));
    EXPECT_THAT(report, HasSubstr("- box2d: the scatter of the restitution of \"stone\" is left out"));
    for (const char* file :
         {"values.csv", "series.csv", "observables.png", "observables.pdf", "frames/000000.png", "frames/000002.png"}) {
        EXPECT_GT(fs::file_size(scratch / "both" / file), 100U) << file;
    }
    EXPECT_FALSE(fs::exists(scratch / "both/frames/000003.png"));

    EXPECT_EQ(
        run_polargrain({"compare", "disks.toml", "--engines", "contact,box2d", "-o", "both"}, scratch.path()).exit_code,
        2);
}

TEST(Compare, TakesItsFolderBeforeTheFirstRunAndLeavesNoneWhenInterrupted) {
    const ScratchFolder scratch;
    scratch.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e5"));
    const std::vector<std::string> words{"compare", "long.toml", "--engines", "contact,box2d", "-o", "both"};
    RunningProgram program(words, scratch.path());
    ASSERT_TRUE(wait_for(scratch / "both"));
    const Outcome second = run_polargrain(words, scratch.path());
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_THAT(second.err, HasSubstr("another polargrain is running in this folder"));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().exit_code, 130);
    EXPECT_FALSE(fs::exists(scratch / "both"));
}

TEST(Compare, FindsOutBeforeTheFirstRunThatItsFolderCannotBeMade) {
    const ScratchFolder scratch;
    scratch.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e5"));
    const Outcome outcome = run_polargrain(
        {"compare", "long.toml", "--engines", "contact,box2d", "-o", "/proc/nowhere/both"}, scratch.path());
    EXPECT_THAT(outcome.exit_code, testing::AnyOf(1, 2)) << "the system lets only some try";
    EXPECT_THAT(outcome.err, HasSubstr("/proc/nowhere/both: "));
}

TEST(Compare, ForceReplacesAComparisonAndNothingElse) {
    const ScratchFolder scratch;
    scratch.write("disks.toml", k_three_disks);
    const std::vector<std::string> words{"compare", "disks.toml", "--engines", "contact,box2d", "-o",
                                         "both",    "--seeds",    "1",         "--force"};
    fs::create_directories(scratch / "both");
    scratch.write("both/series.csv", "mine");
    const Outcome refused = run_polargrain(words, scratch.path());
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("there is no comparison in the folder, but series.csv"));
    EXPECT_EQ(read_file(scratch / "both/series.csv"), "mine");
    fs::remove(scratch / "both/series.csv");
    scratch.write("both/scenario.toml", "mine");
    for (int k = 0; k < 2; ++k) {
        const Outcome outcome = run_polargrain(words, scratch.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    EXPECT_EQ(read_file(scratch / "both/scenario.toml"), "mine");
}

TEST(Compare, RefusesWhatCannotBeCompared) {
    const struct {
        std::vector<std::string> arguments;
        const char* says;
    } mistakes[] = {
        {{"--engines", "contact"}, "two at least"},
        {{"--engines", "contact,contact"}, "named twice"},
        {{"--engines", "contact,box3d"}, "--engines: there is no engine \"box3d\"; did you mean \"box2d\""},
        {{"--engines", "foo"}, "--engines: there is no engine \"foo\""},
        {{"--seeds", "0"}, "seeds"},
    };
    const ScratchFolder scratch;
    scratch.write("disks.toml", k_three_disks);
    for (const auto& [arguments, says] : mistakes) {
        std::vector<std::string> all{"compare", "disks.toml", "-o", "nothing"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run_polargrain(all, scratch.path());
        EXPECT_EQ(outcome.exit_code, 2) << arguments.back();
        EXPECT_THAT(outcome.err, HasSubstr(says));
        EXPECT_FALSE(fs::exists(scratch / "nothing"));
    }
}

TEST(Box2dRun, RefusesAStepAtWhichSpeedsWouldBeCutOffAndLeavesNothing) {
    const ScratchFolder scratch;
    scratch.write("disks.toml", k_three_disks);
    const Outcome outcome = run_polargrain(
        {"run", "disks.toml", "--engine", "box2d", "--set", "run.time_step=0.02", "-o", "out"}, scratch.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("disks.toml: box2d: at up to"));
    EXPECT_THAT(outcome.err, HasSubstr("use run.time_step = 0.00"));
    EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST(DemRun, TellsThatImpactsAreNotDescribed) {
    const ScratchFolder scratch;
    scratch.write("disks.toml", k_three_disks);
    const Outcome outcome = run_polargrain(
        {"run", "disks.toml", "--engine", "dem", "-o", "out", "--set", "output.impacts=true"}, scratch.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("impacts.csv would stay empty"));
    const auto summary = nlohmann::json::parse(read_file(scratch / "out/summary.json"));
    EXPECT_THAT(summary["notes"].back().get<std::string>(), HasSubstr("impacts.csv would stay empty"));
}

TEST(Box2dRun, TellsWhatIsLeftOutInItsLogAndInTheSummary) {
    const ScratchFolder scratch;
    scratch.write("disks.toml", k_three_disks);
    const Outcome outcome = run_polargrain({"run", "disks.toml", "--engine", "box2d", "-o", "out"}, scratch.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("  note       restitution is Newton's"));
    const auto summary = nlohmann::json::parse(read_file(scratch / "out/summary.json"));
    EXPECT_EQ(summary["engine"], "box2d");
    ASSERT_EQ(summary["notes"].size(), 4U);
    EXPECT_THAT(summary["notes"].back().get<std::string>(), HasSubstr("scatter"));
}

}  // namespace
}  // namespace polargrain
