#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string with_band(const std::string& band) {
    return k_three_disks + "\n[[expect]]\nquantity = \"centre_of_mass_y\"\n" + band +
           "\nunit = \"mm\"\nsource = \"the disks lie on the floor, their centres 10 mm above it\"\n";
}

class Verify : public testing::Test {
protected:
    Outcome verify(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "verify");
        return run_polargrain(arguments, scratch_.path());
    }
    ScratchFolder scratch_;
};

TEST_F(Verify, PrintsATableAndEndsWithZeroWhereAllHolds) {
    scratch_.write("three.toml", with_band("min = 9.9\nmax = 11.0"));
    const Outcome outcome = verify({"three.toml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("three: Three disks"));
    EXPECT_THAT(outcome.out, HasSubstr("centre_of_mass_y [mm]"));
    EXPECT_THAT(outcome.out, HasSubstr("9.9 to 11"));
    EXPECT_THAT(outcome.out, HasSubstr("  ok  "));
    EXPECT_THAT(outcome.out, HasSubstr("the disks lie on the floor"));
    EXPECT_FALSE(fs::exists(scratch_ / "out")) << "nothing is kept unless asked for";
}

TEST_F(Verify, EndsWithOneWhereSomethingFallsShort) {
    scratch_.write("three.toml", with_band("max = 9.0"));
    const Outcome outcome = verify({"three.toml"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("<= 9 "));
    EXPECT_THAT(outcome.out, HasSubstr("FALLS SHORT"));
}

TEST_F(Verify, WhatHasNoValueFallsShort) {
    scratch_.write("three.toml", k_three_disks + "\n[[expect]]\nquantity = \"domino_speed\"\nmin = 0\n");
    const Outcome outcome = verify({"three.toml"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("no value"));
}

TEST_F(Verify, KeepsRunsOfSeveralSeedsAndTheirTable) {
    scratch_.write("three.toml", with_band("min = 9.9\nmax = 11.0"));
    const Outcome outcome = verify({"three.toml", "-o", "kept", "--seeds", "3"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(" +- "));
    for (const char* folder : {"three-seed3", "three-seed4", "three-seed5"}) {
        EXPECT_TRUE(fs::exists(scratch_ / "kept" / folder / "summary.json")) << folder;
    }
    const std::string table = read_file(scratch_ / "kept" / "verify.csv");
    EXPECT_THAT(table, HasSubstr("scenario,quantity,unit,measured,spread,runs,min,max,verdict,source\n"));
    EXPECT_THAT(table, HasSubstr("three,centre_of_mass_y,mm,"));
    const Outcome again = verify({"three.toml", "-o", "kept", "--seeds", "3"});
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_THAT(again.err, HasSubstr("--force"));
}

TEST_F(Verify, TellsWhereGrainsHadNotComeToRest) {
    scratch_.write("three.toml", with_band("min = 9.0\nmax = 12.0") + "\n[settle]\nat_most = 1e-3\n");
    const Outcome outcome = verify({"three.toml", "--seeds", "2", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("  note: the grains of 2 of 2 runs were not yet at rest at time zero"));
}

// Disks of random sizes: the diameter that lengths are counted in is another for each seed.
TEST_F(Verify, CountsEverySeedInItsOwnUnits) {
    scratch_.write("sizes.toml", R"(
[run]
duration = 0.01
[materials.m]
density = 1000.0
restitution = 0.5
friction = 0.3
[shapes.ball]
type = "disk"
radius = 0.05
[[walls]]
name = "floor"
material = "m"
points = [[-1.0, -1.0], [1.0, -1.0]]
[[fill]]
count = 1
shapes = ["ball"]
material = "m"
region = [[-0.5, 0.0], [0.5, 1.0]]
size = { distribution = "uniform", min = 0.2, max = 2.0 }
[[expect]]
quantity = "centre_of_mass_y"
unit = "d"
min = 0.0
)");
    const auto measured = [&](std::vector<std::string> arguments, const std::string& folder) {
        arguments.insert(arguments.begin(), {"sizes.toml", "-o", folder});
        EXPECT_EQ(verify(arguments).exit_code, 0);
        const std::string table = read_file(scratch_ / folder / "verify.csv");
        const std::string row = table.substr(table.find("\nsizes,centre_of_mass_y,d,") + 26);
        return std::stod(row);
    };
    double sum = 0.0;
    for (const char* seed : {"1", "2", "3"})
        sum += measured({"--set", std::string("run.seed=") + seed}, std::string("one") + seed);
    EXPECT_NEAR(measured({"--set", "run.seed=1", "--seeds", "3"}, "three"), sum / 3.0, 1e-3 * sum);
}

TEST_F(Verify, DoesNotReplaceATableUnasked) {
    scratch_.write("three.toml", with_band("min = 9.9"));
    scratch_.write("four.toml", with_band("min = 9.8"));
    ASSERT_EQ(verify({"three.toml", "-o", "kept"}).exit_code, 0);
    const std::string table = read_file(scratch_ / "kept" / "verify.csv");
    const Outcome refused = verify({"four.toml", "-o", "kept"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("kept/verify.csv"), HasSubstr("--force")));
    EXPECT_EQ(read_file(scratch_ / "kept" / "verify.csv"), table);
    EXPECT_FALSE(fs::exists(scratch_ / "kept" / "four")) << "before anything runs";
    EXPECT_EQ(verify({"four.toml", "-o", "kept", "--force"}).exit_code, 0);
}

TEST_F(Verify, AScenarioThatExpectsNothingIsWrongInput) {
    scratch_.write("three.toml", k_three_disks);
    const Outcome outcome = verify({"three.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("three.toml: has no [[expect]] entries"));
}

TEST_F(Verify, ReadsEveryScenarioBeforeItRunsTheFirst) {
    scratch_.write("good.toml", with_band("min = 9.9"));
    scratch_.write("bad.toml", with_band("mni = 9.9"));
    const Outcome outcome = verify({"good.toml", "bad.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("bad.toml"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("(1 of 2)")));
}

TEST_F(Verify, ObservablesBecomeColumnsOfTheSeries) {
    scratch_.write("three.toml", replaced(k_three_disks, "series = { every = 0.01 }",
                                          "series = { every = 0.01 }\nobserve = [\"deepest_overlap\", { quantity = "
                                          "\"mean_velocity_x\", label = \"drift\", region = [[0, 0], [1, 1]] }]"));
    const Outcome outcome = run_polargrain({"run", "three.toml", "-o", "kept"}, scratch_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string series = read_file(scratch_ / "kept" / "series.csv");
    EXPECT_THAT(series.substr(0, series.find('\n')), HasSubstr(",deepest_overlap,drift"));
}

TEST_F(Verify, RefusesSeedsThatAreNotThereBeforeTheFirstRun) {
    scratch_.write("three.toml", with_band("min = 9.9"));
    const Outcome refused = verify({"three.toml", "--seed", "9007199254740992", "--seeds", "2"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--seeds 2: there are not so many from run.seed = 9007199254740992 on"));
    EXPECT_THAT(refused.out, Not(HasSubstr("(1 of 1)")));
}

TEST_F(Verify, ThatIsInterruptedSaysHowToVerifyAgain) {
    scratch_.write("long.toml", replaced(with_band("min = 9.9"), "duration = 0.05", "duration = 1e6"));
    RunningProgram program({"verify", "long.toml", "-o", "kept"}, scratch_.path());
    ASSERT_TRUE(wait_for(scratch_ / "kept" / "long" / "checkpoint.h5"));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_THAT(outcome.err,
                testing::AllOf(HasSubstr("polargrain verify long.toml -o kept --force"), Not(HasSubstr("resume"))));
}

TEST_F(Verify, SaysThatTheTemporaryFolderIsMissing) {
    scratch_.write("three.toml", with_band("min = 9.9"));
    const char* before = std::getenv("TMPDIR");
    const std::string kept = before != nullptr ? before : "";
    setenv("TMPDIR", "/no/such/folder", 1);
    // Not by run_polargrain, which needs such a folder itself.
    const int status = std::system(("cd " + scratch_.path().string() +
                                    " && " POLARGRAIN_BINARY_DIR "/polargrain verify three.toml 2>said >/dev/null")
                                       .c_str());
    before != nullptr ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_THAT(read_file(scratch_ / "said"), testing::AllOf(HasSubstr("TMPDIR=/no/such/folder"), HasSubstr("-o")));
}

TEST_F(Verify, TheListNamesEveryObservable) {
    const Outcome outcome = run_polargrain({"list", "observables"}, scratch_.path());
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* name : {"domino_speed", "bridge_life", "wall_pressure", "mixing_index", "angle_of_repose"}) {
        EXPECT_THAT(outcome.out, HasSubstr(name));
    }
}

}  // namespace
}  // namespace polargrain
