#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class RunFolder : public testing::Test {
protected:
    RunFolder() { scratch_.write("three.toml", k_three_disks); }
    Outcome run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "run");
        return run_polargrain(arguments, scratch_.path());
    }
    ScratchFolder scratch_;
};

TEST_F(RunFolder, NeverReplacesTheScenarioThatIsRead) {
    fs::create_directories(scratch_ / "mine");
    scratch_.write("mine/scenario.toml", k_three_disks);
    fs::create_symlink("mine/scenario.toml", scratch_ / "link.toml");
    for (const char* scenario : {"mine/scenario.toml", "link.toml"}) {
        for (const char* force : {"--quiet", "--force"}) {
            const Outcome refused = run({scenario, "-o", "mine", force});
            EXPECT_EQ(refused.exit_code, 2);
            EXPECT_THAT(refused.err, AllOf(HasSubstr("is the scenario that is read"), HasSubstr("another folder")));
        }
    }
    EXPECT_EQ(read_file(scratch_ / "mine" / "scenario.toml"), k_three_disks);
    EXPECT_FALSE(fs::exists(scratch_ / "mine" / "series.csv"));
}

TEST_F(RunFolder, TakesTheScenarioOfARunAgainOnlyAsItIs) {
    ASSERT_EQ(run({"three.toml", "-o", "run"}).exit_code, 0);
    const std::string resolved = read_file(scratch_ / "run" / "scenario.toml");
    EXPECT_EQ(run({"run/scenario.toml", "-o", "run", "--force"}).exit_code, 0);
    EXPECT_EQ(read_file(scratch_ / "run" / "scenario.toml"), resolved);
    const Outcome refused = run({"run/scenario.toml", "-o", "run", "--force", "--seed", "9"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("would replace it"));
    EXPECT_EQ(read_file(scratch_ / "run" / "scenario.toml"), resolved);
}

TEST_F(RunFolder, ForceReplacesNoFileWhereThereIsNoRun) {
    fs::create_directories(scratch_ / "mine" / "frames");
    for (const char* name :
         {"scenario.toml", "summary.json", "series.csv", "trajectory.h5", "checkpoint.h5", "frames/000000.png"}) {
        scratch_.write(std::string("mine/") + name, "mine");
        for (const char* force : {"--quiet", "--force"}) {
            const Outcome refused = run({"three.toml", "-o", "mine", force});
            EXPECT_EQ(refused.exit_code, 2) << name;
            EXPECT_THAT(refused.err, AllOf(HasSubstr("there is no run in the folder"),
                                           HasSubstr(std::string(name).substr(0, std::string(name).find('/'))),
                                           testing::Not(HasSubstr("--force"))));
        }
        EXPECT_EQ(read_file(scratch_ / "mine" / name), "mine");
        fs::remove(scratch_ / "mine" / name);
    }
}

TEST_F(RunFolder, ForcePutsARunBesideWhatIsNoneOfIts) {
    fs::create_directories(scratch_ / "mine");
    for (const char* name : {"mine/notes.txt", "mine/sheet.png"}) scratch_.write(name, "mine");
    const Outcome refused = run({"three.toml", "-o", "mine"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--force to put the run beside what is in it"));
    EXPECT_EQ(run({"three.toml", "-o", "mine", "--force"}).exit_code, 0);
    for (const char* name : {"notes.txt", "sheet.png"}) EXPECT_EQ(read_file(scratch_ / "mine" / name), "mine");
}

TEST_F(RunFolder, ThatCannotBeIsWrongInputBeforeAnythingIsSaid) {
    fs::create_symlink("nowhere", scratch_ / "dangling");
    const std::string long_name(300, 'x');
    std::string long_path;
    for (int k = 0; k < 30; ++k) long_path += std::string(200, 'y') + "/";
    for (const std::string& place :
         {std::string("three.toml"), std::string("three.toml/below"), std::string("three.toml/far/below"),
          std::string("dangling"), std::string("dangling/below"), long_name, "new/" + long_name, long_path}) {
        const Outcome refused = run({"three.toml", "-o", place});
        EXPECT_EQ(refused.exit_code, 2) << place << refused.err;
        EXPECT_THAT(refused.err, AllOf(HasSubstr("error: " + place), HasSubstr("give another folder with -o")));
        EXPECT_THAT(refused.out, IsEmpty());
        EXPECT_FALSE(fs::exists(scratch_ / "new"));
    }
    EXPECT_EQ(read_file(scratch_ / "three.toml"), k_three_disks);
    const Outcome sweep = run_polargrain({"sweep", "three.toml", "-o", "dangling"}, scratch_.path());
    EXPECT_EQ(sweep.exit_code, 2);
}

}  // namespace
}  // namespace polargrain
