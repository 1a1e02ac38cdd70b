#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string k_sweep = R"(scenario = "three.toml"
seeds = [3, 4]

[set]
run.duration = 0.02

[vary]
materials.stone.friction = [0.1, 0.4]
"rows[0].first.velocity" = [[1.0, 0.0], [0.5, 0.0]]
)";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

class Sweep : public testing::Test {
protected:
    Sweep() {
        scratch_.write("three.toml", k_three_disks);
        scratch_.write("sweep.toml", k_sweep);
    }
    Outcome polargrain(const std::vector<std::string>& arguments) const {
        return run_polargrain(arguments, scratch_.path());
    }
    std::string refusal_of(const std::string& text) const {
        scratch_.write("wrong.toml", text);
        const Outcome outcome = polargrain({"sweep", "wrong.toml", "-o", "wrong"});
        EXPECT_EQ(outcome.exit_code, 2) << text;
        EXPECT_FALSE(fs::exists(scratch_ / "wrong")) << "nothing is written";
        return outcome.err;
    }
    ScratchFolder scratch_;
};

TEST_F(Sweep, RunsEachValueWithEachOtherAndTabulatesThem) {
    const Outcome outcome = polargrain({"sweep", "sweep.toml", "-o", "swept", "--jobs", "2"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("8 runs, 0 failed"));
    const std::vector<std::string> rows = lines_of(read_file(scratch_ / "swept" / "table.csv"));
    ASSERT_EQ(rows.size(), 9U);
    EXPECT_THAT(rows[0], HasSubstr("run,materials.stone.friction,rows[0].first.velocity,engine,seed,status,steps,"));
    EXPECT_THAT(rows[0], HasSubstr(",kinetic_energy_per_grain"));
    EXPECT_THAT(rows[1], testing::StartsWith("0000,0.1,\"[1.0, 0.0]\",contact,3,done,200,0.02,"));
    EXPECT_THAT(rows[8], testing::StartsWith("0007,0.4,\"[0.5, 0.0]\",contact,4,done,200,0.02,"));

    ASSERT_EQ(polargrain({"run", "three.toml", "-o", "alone", "--seed", "4", "--set", "run.duration=0.02", "--set",
                          "materials.stone.friction=0.4", "--set", "rows[0].first.velocity=[0.5,0.0]"})
                  .exit_code,
              0);
    const auto summary = nlohmann::json::parse(read_file(scratch_ / "alone" / "summary.json"));
    EXPECT_THAT(rows[8], HasSubstr(summary.at("state_hash").get<std::string>())) << "as that run alone gives it";
}

TEST_F(Sweep, GoesOnAfterAKill) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "whole"}).exit_code, 0);
    for (const int signal : {SIGKILL, SIGINT}) {
        RunningProgram program({"sweep", "sweep.toml", "-o", "cut", "--force"}, scratch_.path());
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!fs::exists(scratch_ / "cut" / "runs" / "0002") && std::chrono::steady_clock::now() < give_up) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        program.send(signal);
        EXPECT_EQ(program.wait().exit_code, signal == SIGKILL ? -SIGKILL : 130);
        EXPECT_FALSE(fs::exists(scratch_ / "cut" / "table.csv"));
        const Outcome resumed = polargrain({"sweep", "sweep.toml", "-o", "cut"});
        ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
        EXPECT_EQ(read_file(scratch_ / "cut" / "table.csv"), read_file(scratch_ / "whole" / "table.csv"));
        fs::remove_all(scratch_ / "cut");
    }
}

TEST_F(Sweep, ASignalToAllItsProgramsLetsEachRunWriteACheckpoint) {
    scratch_.write("long.toml", replaced(k_sweep, "run.duration = 0.02", "run.duration = 1e5"));
    for (const int signal : {SIGINT, SIGTERM}) {
        RunningProgram program({"sweep", "long.toml", "-o", "cut", "--jobs", "2"}, scratch_.path());
        const fs::path runs = scratch_ / "cut" / "runs";
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!(fs::exists(runs / "0000" / "checkpoint.h5") && fs::exists(runs / "0001" / "checkpoint.h5")) &&
               std::chrono::steady_clock::now() < give_up) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        program.send_to_all(signal);
        EXPECT_EQ(program.wait().exit_code, 130);
        for (const char* run : {"0000", "0001"}) {
            const auto summary = nlohmann::json::parse(read_file(runs / run / "summary.json"), nullptr, false);
            ASSERT_TRUE(summary.is_object()) << run << " was ended without a summary, nor a checkpoint";
            EXPECT_EQ(summary.at("interrupted"), true);
        }
        fs::remove_all(scratch_ / "cut");
    }
}

TEST_F(Sweep, RefusesToReplaceRunsOfAScenarioThatHasBeenChangedSince) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    const std::string table = read_file(scratch_ / "swept" / "table.csv");
    const std::string summary = read_file(scratch_ / "swept" / "runs" / "0000" / "summary.json");
    scratch_.write("three.toml", replaced(k_three_disks, "density = 2000.0", "density = 2500.0"));
    const Outcome refused = polargrain({"sweep", "sweep.toml", "-o", "swept"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("three.toml: has been changed"), HasSubstr("--force")));
    EXPECT_EQ(read_file(scratch_ / "swept" / "table.csv"), table);
    EXPECT_EQ(read_file(scratch_ / "swept" / "runs" / "0000" / "summary.json"), summary);
    EXPECT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept", "--force"}).exit_code, 0);
    EXPECT_NE(read_file(scratch_ / "swept" / "table.csv"), table);
}

TEST_F(Sweep, ThatReplacesAnotherGoesOnWithoutForceAfterCtrlC) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    scratch_.write("three.toml", replaced(k_three_disks, "density = 2000.0", "density = 2500.0"));
    scratch_.write("slow.toml", replaced(k_sweep, "run.duration = 0.02", "run.duration = 1e5"));
    RunningProgram program({"sweep", "slow.toml", "-o", "swept", "--force"}, scratch_.path());
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    const fs::path first = scratch_ / "swept" / "runs" / "0000";
    const auto begun = [&] {  // anew: the scenario of the old one goes first, and its checkpoint last
        return fs::exists(first / "scenario.toml") && !fs::exists(first / "summary.json") &&
               fs::exists(first / "checkpoint.h5");
    };
    while (!begun() && std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    program.send_to_all(SIGINT);
    EXPECT_EQ(program.wait().exit_code, 130);
    RunningProgram again({"sweep", "slow.toml", "-o", "swept"}, scratch_.path());
    while (fs::exists(first / "summary.json") && std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    again.send_to_all(SIGINT);
    EXPECT_EQ(again.wait().exit_code, 130) << "is not refused";
}

TEST_F(Sweep, ThatReplacesALargerOneLeavesNothingOfIt) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    scratch_.write("swept/runs/0005/mine.txt", "mine");
    scratch_.write("swept/runs/0009.log", "what a run that failed had to say");
    fs::create_directories(scratch_ / "swept" / "runs" / "007");
    scratch_.write("smaller.toml", replaced(k_sweep, "seeds = [3, 4]", "seeds = [3]"));
    ASSERT_EQ(polargrain({"sweep", "smaller.toml", "-o", "swept", "--force"}).exit_code, 0);
    EXPECT_EQ(lines_of(read_file(scratch_ / "swept" / "table.csv")).size(), 5U);
    std::set<std::string> left;
    for (const auto& entry : fs::directory_iterator(scratch_ / "swept" / "runs")) left.insert(entry.path().filename());
    EXPECT_THAT(left, testing::ElementsAre("0000", "0001", "0002", "0003", "0005", "007"));
    EXPECT_FALSE(fs::exists(scratch_ / "swept" / "runs" / "0005" / "scenario.toml"));
    EXPECT_EQ(read_file(scratch_ / "swept" / "runs" / "0005" / "mine.txt"), "mine");
}

TEST_F(Sweep, ThatReplacesAnotherAndIsStoppedLeavesNoTable) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    scratch_.write("slow.toml", replaced(k_sweep, "run.duration = 0.02", "run.duration = 1e5"));
    RunningProgram program({"sweep", "slow.toml", "-o", "swept", "--force"}, scratch_.path());
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!testing::Value(read_file(scratch_ / "swept" / "sweep.toml"), HasSubstr("1e5")) &&
           std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    program.send_to_all(SIGKILL);
    program.wait();
    EXPECT_FALSE(fs::exists(scratch_ / "swept" / "table.csv"));
}

TEST_F(Sweep, LeavesCompleteRunsAlone) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    const auto written = fs::last_write_time(scratch_ / "swept" / "runs" / "0003" / "summary.json");
    const Outcome again = polargrain({"sweep", "sweep.toml", "-o", "swept"});
    ASSERT_EQ(again.exit_code, 0);
    EXPECT_THAT(again.out, HasSubstr("8 of them done already"));
    EXPECT_EQ(fs::last_write_time(scratch_ / "swept" / "runs" / "0003" / "summary.json"), written);
}

TEST_F(Sweep, RunsAgainWhatHasLeftADamagedSummary) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    const std::string table = read_file(scratch_ / "swept" / "table.csv");
    for (const char* damaged :
         {"", "{", "[]", "{\"interrupted\": 3}", "{\"interrupted\": false, \"observables\": 3}"}) {
        scratch_.write("swept/runs/0003/summary.json", damaged);
        const Outcome again = polargrain({"sweep", "sweep.toml", "-o", "swept"});
        EXPECT_EQ(again.exit_code, 0) << damaged << again.err;
        EXPECT_THAT(again.out, HasSubstr("7 of them done already"));
        EXPECT_EQ(read_file(scratch_ / "swept" / "table.csv"), table) << damaged;
    }
}

TEST_F(Sweep, RefusesTheFolderOfAnother) {
    ASSERT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept"}).exit_code, 0);
    scratch_.write("sweep.toml", replaced(k_sweep, "0.4", "0.5"));
    const Outcome refused = polargrain({"sweep", "sweep.toml", "-o", "swept"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--force"));
    EXPECT_EQ(polargrain({"sweep", "sweep.toml", "-o", "swept", "--force"}).exit_code, 0);
    EXPECT_THAT(read_file(scratch_ / "swept" / "table.csv"), HasSubstr("0007,0.5,"));
}

TEST_F(Sweep, SaysWhatIsWrongInItsFile) {
    EXPECT_THAT(refusal_of("seeds = 2\n"), HasSubstr("scenario: is missing"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nsedes = 2\n"),
                HasSubstr("wrong.toml:2:1: sedes: unknown key; the "
                          "nearest is seeds"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nseeds = -2\n"), HasSubstr("wrong.toml:2:9: seeds"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\n[vary]\nrun.seed = [1]\n"), HasSubstr("by the key seeds"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\n[vary]\nrun.duration = 1\n"), HasSubstr("put it in [ ]"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\n[vary]\nrun.duratoin = [1]\n"), HasSubstr("duration"));
    EXPECT_THAT(refusal_of("scenario = \"four.toml\"\n"), HasSubstr("wrong.toml:1:12: scenario: four.toml"));
    EXPECT_THAT(refusal_of("scenario = \n"), HasSubstr("not valid TOML"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nframes = \"true\"\n"),
                HasSubstr("wrong.toml:2:10: frames: is a string, must be true or false"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nseeds = 10000000000\n"),
                HasSubstr("wrong.toml:2:9: seeds: 10000000000 are more than the 100000 runs"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nseeds = 100000\nengines = [\"contact\", \"dem\"]\n"),
                HasSubstr("makes 200000 runs"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\n[vary]\nmaterials.stone.friction = [0.1, -1.0]\n"),
                HasSubstr("wrong.toml:3:34: materials.stone.friction: is -1"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\n[set]\nmaterials.stone.densty = 1.0\n"),
                HasSubstr("wrong.toml:3:26: unknown key materials.stone.densty"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nengines = [\"box3d\"]\n"),
                HasSubstr("wrong.toml:2:12: run.engine"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nseeds = [1, 2, 1]\n"),
                HasSubstr("wrong.toml:2:16: seeds: 1 stands there twice"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\nengines = [\"dem\", \"dem\"]\n"),
                HasSubstr("\"dem\" stands there"));
    EXPECT_THAT(refusal_of("scenario = \"three.toml\"\n[set]\nrun.duration = 1.0\n[vary]\n\"run.duration\" = [1.0]\n"),
                HasSubstr("wrong.toml:5:18: run.duration: stands in [set] too"));
    EXPECT_THAT(
        refusal_of(
            "scenario = \"three.toml\"\n[set]\n\"grains.0.friction\" = 1.0\n[vary]\n\"grains[0].friction\" = [1.0]\n"),
        HasSubstr("wrong.toml:5:24: grains[0].friction: stands in [set] too"));
    EXPECT_THAT(
        refusal_of(
            "scenario = \"three.toml\"\n[vary]\n\"grains.0.friction\" = [1.0]\n\"grains[0].friction\" = [0.5]\n"),
        HasSubstr("stands in this table already, spelt otherwise"));
    EXPECT_EQ(polargrain({"sweep", "none.toml"}).exit_code, 2);
    fs::create_directories(scratch_ / "folder");
    const Outcome folder = polargrain({"sweep", "folder"});
    EXPECT_EQ(folder.exit_code, 2);
    EXPECT_THAT(folder.err, HasSubstr("is a folder"));
}

TEST_F(Sweep, NamesTheCombinationThatCannotBeRun) {
    // Each value is right by itself; large disks in narrow rows overlap.
    const std::string refusal = refusal_of(
        "scenario = \"three.toml\"\nseeds = [7]\n[vary]\nshapes.disk.radius = [0.01, 0.02]\n"
        "\"rows[0].step\" = [[0.05, 0.0], [0.025, 0.0]]\n\"rows[0].start\" = [[0.0, 0.03]]\n");
    EXPECT_THAT(refusal, HasSubstr("overlap"));
    EXPECT_THAT(refusal, HasSubstr("rows[0].start=[0.0, 0.03], rows[0].step=[0.025, 0.0], shapes.disk.radius=0.02, "
                                   "run.seed=7"));
}

TEST_F(Sweep, DoesNotTakeAFolderWithATableOfSomethingElse) {
    fs::create_directories(scratch_ / "mine");
    scratch_.write("mine/table.csv", "mine");
    const Outcome refused = polargrain({"sweep", "sweep.toml", "-o", "mine", "--force"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("there is no sweep in the folder, but table.csv"));
    EXPECT_EQ(read_file(scratch_ / "mine" / "table.csv"), "mine");
}

TEST_F(Sweep, TellsWhichRunsHadNotComeToRest) {
    scratch_.write("three.toml", k_three_disks + "[settle]\nat_most = 1e-3\n");
    const Outcome outcome = polargrain({"sweep", "sweep.toml", "-o", "swept", "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the grains of 8 of 8 runs were not yet at rest"));
    const std::vector<std::string> rows = lines_of(read_file(scratch_ / "swept" / "table.csv"));
    EXPECT_THAT(rows[0], HasSubstr(",state_hash,settled,"));
    EXPECT_THAT(rows[1], HasSubstr(",no,"));
}

}  // namespace
}  // namespace polargrain
