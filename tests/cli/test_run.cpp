#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

nlohmann::json summary_of(const fs::path& folder) { return nlohmann::json::parse(read_file(folder / "summary.json")); }

std::string state_hash_of(const fs::path& folder) { return summary_of(folder).at("state_hash"); }

class Run : public testing::Test {
protected:
    Outcome run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "run");
        return run_polargrain(arguments, scratch_.path());
    }
    ScratchFolder scratch_;
};

TEST_F(Run, WritesARunFolderUnderOutByDefault) {
    scratch_.write("three.toml", k_three_disks);
    const Outcome outcome = run({"three.toml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    EXPECT_THAT(outcome.out, HasSubstr("state hash"));
    for (const char* file : {"scenario.toml", "summary.json", "series.csv", "trajectory.h5"}) {
        EXPECT_TRUE(fs::exists(scratch_ / "out" / "three" / file)) << file;
    }
    EXPECT_FALSE(fs::exists(scratch_ / "out" / "three" / "frames")) << "frames are switched off";
    EXPECT_EQ(summary_of(scratch_ / "out" / "three").at("steps"), 500);
}

TEST_F(Run, WithoutStandardStreamsPrintsIntoNoneOfItsFiles) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    ASSERT_EQ(
        std::system(("cd " + scratch_.path().string() +
                     " && { " POLARGRAIN_BINARY_DIR "/polargrain run long.toml -o long <&- >&- 2>&- & echo $! > pid; }")
                        .c_str()),
        0);
    ASSERT_TRUE(wait_for(scratch_ / "long" / "checkpoint.h5"));
    const int pid = std::stoi(read_file(scratch_ / "pid"));
    for (const char* stream : {"0", "1", "2"}) {
        EXPECT_EQ(fs::read_symlink("/proc/" + std::to_string(pid) + "/fd/" + stream), "/dev/null") << stream;
    }
    kill(pid, SIGKILL);
}

TEST_F(Run, TheSameScenarioGivesTheSameStateAndAnotherSeedAnother) {
    scratch_.write("three.toml", k_three_disks);
    for (const char* folder : {"a", "b"}) ASSERT_EQ(run({"three.toml", "-o", folder}).exit_code, 0);
    ASSERT_EQ(run({"three.toml", "-o", "c", "--seed", "4"}).exit_code, 0);
    EXPECT_EQ(state_hash_of(scratch_ / "a"), state_hash_of(scratch_ / "b"));
    EXPECT_EQ(read_file(scratch_ / "a" / "series.csv"), read_file(scratch_ / "b" / "series.csv"));
    EXPECT_NE(state_hash_of(scratch_ / "a"), state_hash_of(scratch_ / "c")) << "restitution is drawn by the seed";
}

TEST_F(Run, TheScenarioOfARunFolderGivesTheSameStateAgain) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "first", "--set", "run.gravity=3.3", "--seed", "99"}).exit_code, 0);
    ASSERT_EQ(run({"first/scenario.toml", "-o", "again"}).exit_code, 0);
    EXPECT_EQ(state_hash_of(scratch_ / "first"), state_hash_of(scratch_ / "again"));
    EXPECT_EQ(read_file(scratch_ / "first" / "scenario.toml"), read_file(scratch_ / "again" / "scenario.toml"));
}

TEST_F(Run, SettlesBeforeTimeZeroAndRepeatsThatToo) {
    scratch_.write("three.toml", k_three_disks + "[settle]\nuntil_energy = 1e-3\nat_most = 0.2\n");
    const Outcome outcome = run({"three.toml", "-o", "first"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("settling:"));
    ASSERT_EQ(run({"first/scenario.toml", "-o", "again"}).exit_code, 0);
    EXPECT_EQ(state_hash_of(scratch_ / "first"), state_hash_of(scratch_ / "again"));
}

TEST_F(Run, TellsWhereTheGrainsHadNotComeToRest) {
    scratch_.write("three.toml", k_three_disks + "[settle]\nat_most = 1e-3\n");
    ASSERT_EQ(run({"three.toml", "-o", "restless", "--quiet"}).exit_code, 0);
    const nlohmann::json restless = summary_of(scratch_ / "restless");
    EXPECT_EQ(restless.at("settling").at("at_rest"), false);
    EXPECT_EQ(restless.at("settling").at("seconds"), 1e-3);
    EXPECT_EQ(restless.at("settling").at("at_most"), 1e-3);
    EXPECT_EQ(restless.at("settling").at("until_energy"), 1e-6);
    EXPECT_GT(restless.at("settling").at("energy").get<double>(), 1e-6);
    EXPECT_THAT(restless.at("notes").back().get<std::string>(), HasSubstr("not yet at rest at time zero"));
    EXPECT_THAT(run({"three.toml", "-o", "told"}).out, HasSubstr("  note             the grains were not yet at rest"));

    ASSERT_EQ(run({"three.toml", "-o", "at-rest", "--set", "settle.at_most=1", "--set", "rows[0].first={}"}).exit_code,
              0);
    EXPECT_EQ(summary_of(scratch_ / "at-rest").at("settling").at("at_rest"), true);
    EXPECT_TRUE(summary_of(scratch_ / "at-rest").at("notes").empty());
    scratch_.write("unasked.toml", k_three_disks);
    ASSERT_EQ(run({"unasked.toml", "-o", "unasked"}).exit_code, 0);
    EXPECT_FALSE(summary_of(scratch_ / "unasked").contains("settling"));
}

TEST_F(Run, TellsOfOverlapsThatTheEngineDoesNotCount) {
    const std::string lid =
        "[[walls]]\nname = \"lid\"\nmaterial = \"stone\"\npoints = [[1.0, 0.03], [-1.0, 0.03]]\n"
        "motion = { type = \"sine\", direction = [0, -1], amplitude = 0.015, frequency = 5.0 }\n\n[[rows]]";
    scratch_.write("pressed.toml", replaced(k_three_disks, "[[rows]]", lid));
    const Outcome outcome = run({"pressed.toml", "-o", "pressed", "--engine", "contact-1994"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json summary = summary_of(scratch_ / "pressed");
    ASSERT_GT(summary.at("observables").at("deepest_overlap").get<double>(),
              summary.at("deepest_overlap").get<double>() + 1e-4);
    EXPECT_THAT(summary.at("notes").back().get<std::string>(), HasSubstr("go by observables.deepest_overlap"));
    EXPECT_THAT(outcome.out, HasSubstr("  note             overlaps of up to"));
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "still", "--engine", "contact-1994"}).exit_code, 0);
    EXPECT_TRUE(summary_of(scratch_ / "still").at("notes").empty());
}

TEST_F(Run, SaysThatThereAreNoGrains) {
    scratch_.write("empty.toml", k_three_disks.substr(0, k_three_disks.find("[[rows]]")));
    const Outcome stepped = run({"empty.toml"});
    EXPECT_EQ(stepped.exit_code, 0) << stepped.err;
    EXPECT_THAT(stepped.out, HasSubstr("  note       the scenario has no grains"));
    scratch_.write("critical.toml", replaced(read_file(scratch_ / "empty.toml"), "time_step = 1e-4", ""));
    const Outcome refused = run({"critical.toml"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("critical.toml: the scenario has no grains"));
}

TEST_F(Run, RefusesAFolderWithSomethingInItUnlessForced) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    const std::string before = read_file(scratch_ / "here" / "summary.json");
    const Outcome refused = run({"three.toml", "-o", "here"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--force"));
    EXPECT_EQ(read_file(scratch_ / "here" / "summary.json"), before) << "nothing is touched";
    EXPECT_EQ(run({"three.toml", "-o", "here", "--force"}).exit_code, 0);
}

TEST_F(Run, ForceRemovesOnlyWhatARunFolderIsMadeOf) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    fs::create_directories(scratch_ / "here" / "frames");
    for (const char* name : {"here/notes.txt", "here/impacts.csv", "here/frames/000007.png", "here/frames/mine.png"}) {
        scratch_.write(name, "old");
    }
    EXPECT_EQ(run({"three.toml", "-o", "here", "--force"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(scratch_ / "here" / "notes.txt"));
    EXPECT_TRUE(fs::exists(scratch_ / "here" / "frames" / "mine.png"));
    EXPECT_FALSE(fs::exists(scratch_ / "here" / "impacts.csv")) << "a stale file of an earlier run";
    EXPECT_FALSE(fs::exists(scratch_ / "here" / "frames" / "000007.png"));
}

TEST_F(Run, ForceRemovesWhatWasMadeOfTheRunThatIsReplaced) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    ASSERT_EQ(run_polargrain({"export", "here", "--format", "vtk,csv"}, scratch_.path()).exit_code, 0);
    ASSERT_EQ(run_polargrain({"render", "here", "--colour", "by=id"}, scratch_.path()).exit_code, 0);
    for (const char* name :
         {"plot.png", "plot.pdf", "plot.csv", "movie-speed.mp4", "export/mine.txt", "plot-of-mine.png"}) {
        scratch_.write(std::string("here/") + name, "old");
    }
    ASSERT_TRUE(fs::exists(scratch_ / "here" / "export" / "grains.csv"));
    ASSERT_TRUE(fs::exists(scratch_ / "here" / "frames-id" / "000000.png"));
    ASSERT_EQ(run({"three.toml", "-o", "here", "--force"}).exit_code, 0);
    for (const char* name : {"plot.png", "plot.pdf", "plot.csv", "movie-speed.mp4", "frames-id", "export/grains.csv",
                             "export/grains.pvd", "export/grains"}) {
        EXPECT_FALSE(fs::exists(scratch_ / "here" / name)) << name << ": of a run that is no longer there";
    }
    EXPECT_TRUE(fs::exists(scratch_ / "here" / "export" / "mine.txt"));
    EXPECT_TRUE(fs::exists(scratch_ / "here" / "plot-of-mine.png"));
}

TEST_F(Run, ForceLeavesFilesAloneWhoseNamesAreOnlyLikeThoseOfItsOwn) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    fs::create_directories(scratch_ / "here" / "frames-for-my-talk");
    const char* const mine[] = {"here/movie-of-my-own.mp4", "here/movie-.mp4", "here/frames-for-my-talk/000000.png",
                                "here/frames-for-my-talk/index.csv"};
    for (const char* name : mine) scratch_.write(name, "mine");
    ASSERT_EQ(run({"three.toml", "-o", "here", "--force"}).exit_code, 0);
    for (const char* name : mine) EXPECT_EQ(read_file(scratch_ / name), "mine") << name;
}

TEST_F(Run, ForceLeavesFoldersAloneThatHaveTheNameOfAFile) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    const char* const mine[] = {"sheet.png", "movie-speed.mp4", "plot.png", "export/grains.csv", "export/grains.pvd"};
    for (const char* name : mine) {
        fs::create_directories(scratch_ / "here" / name);
        scratch_.write(std::string("here/") + name + "/mine.txt", "mine");
    }
    const Outcome replaced = run({"three.toml", "-o", "here", "--force"});
    EXPECT_EQ(replaced.exit_code, 0) << replaced.err;
    for (const char* name : mine) EXPECT_EQ(read_file(scratch_ / "here" / name / "mine.txt"), "mine") << name;
}

TEST_F(Run, ForceKeepsTheOldRunWhereAFolderStandsInPlaceOfAFileOfTheNewOne) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    fs::create_directories(scratch_ / "here" / "impacts.csv" / "mine");
    const Outcome refused = run({"three.toml", "-o", "here", "--force"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("here/impacts.csv: is a folder"));
    for (const char* kept : {"scenario.toml", "trajectory.h5", "summary.json", "checkpoint.h5", "impacts.csv/mine"}) {
        EXPECT_TRUE(fs::exists(scratch_ / "here" / kept)) << kept;
    }
}

TEST_F(Run, ForceLeavesAPictureAloneThatIsNoWholePlot) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    scratch_.write("here/plot.png", "mine");
    ASSERT_EQ(run({"three.toml", "-o", "here", "--force"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(scratch_ / "here" / "plot.png")) << "a plot has three files";
}

TEST_F(Run, RefusesAFileInPlaceOfTheFolder) {
    scratch_.write("three.toml", k_three_disks);
    const Outcome outcome = run({"three.toml", "-o", "three.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(read_file(scratch_ / "three.toml"), k_three_disks);
}

TEST_F(Run, LosesNothingToASecondRunInItsFolder) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    RunningProgram first({"run", "long.toml", "-o", "long"}, scratch_.path());
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!fs::exists(scratch_ / "long" / "checkpoint.h5") && std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Outcome second = run({"long.toml", "-o", "long", "--force"});
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_THAT(second.err, HasSubstr("another polargrain is running"));
    for (const char* file : {"scenario.toml", "checkpoint.h5", "series.csv", "trajectory.h5"}) {
        EXPECT_TRUE(fs::exists(scratch_ / "long" / file)) << file;
    }
    first.send(SIGINT);
    EXPECT_EQ(first.wait().exit_code, 130);
    EXPECT_EQ(summary_of(scratch_ / "long").at("interrupted"), true);
}

TEST_F(Run, KeepsTheOldRunWhereTheNewOneCannotBegin) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "here"}).exit_code, 0);
    const std::string before = read_file(scratch_ / "here" / "summary.json");
    const struct {
        std::vector<std::string> arguments;
        const char* says;
    } cases[] = {{{"three.toml", "--engine", "box2d", "--set", "run.time_step=0.02"}, "Box2D cuts off"},
                 {{"three.toml", "--set", "run.gravity=0", "--set",
                   "output.observe=[{quantity=\"bridge_life\",opening=[[-0.1,0],[0.1,0]]}]"},
                  "gravity"}};
    for (const auto& [arguments, says] : cases) {
        std::vector<std::string> forced = arguments;
        forced.insert(forced.end(), {"-o", "here", "--force"});
        const Outcome refused = run(forced);
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr(says));
        EXPECT_EQ(read_file(scratch_ / "here" / "summary.json"), before);
        std::vector<std::string> checked = arguments;
        checked.insert(checked.begin(), "check");
        EXPECT_EQ(run_polargrain(checked, scratch_.path()).exit_code, 2);
    }
}

TEST_F(Run, ANameThatIsNotUtf8IsRefusedInReadingUnlessThereIsATitle) {
    const std::string untitled = replaced(k_three_disks, "title = \"Three disks\"\n", "");
    scratch_.write("\xff.toml", untitled);
    for (const char* command : {"check", "run"}) {
        const Outcome refused = run_polargrain({command, "\xff.toml"}, scratch_.path());
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr("UTF-8"));
        EXPECT_FALSE(fs::exists(scratch_ / "out"));
    }
    EXPECT_EQ(run({"\xff.toml", "-o", "bad", "--set", "title=\xff"}).exit_code, 2);
    ASSERT_EQ(run({"\xff.toml", "-o", "good", "--set", "title=Disks"}).exit_code, 0);
    EXPECT_EQ(run_polargrain({"resume", "good"}, scratch_.path()).exit_code, 0);
}

TEST_F(Run, QuietPrintsNothing) {
    scratch_.write("three.toml", k_three_disks);
    const Outcome outcome = run({"three.toml", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
}

TEST_F(Run, WritesImpactsOnRequest) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(run({"three.toml", "-o", "with", "--set", "output.impacts=true"}).exit_code, 0);
    ASSERT_EQ(run({"three.toml", "-o", "without"}).exit_code, 0);
    const std::string rows = read_file(scratch_ / "with" / "impacts.csv");
    const auto lines = std::count(rows.begin(), rows.end(), '\n');
    EXPECT_EQ(lines, 1 + summary_of(scratch_ / "with").at("impacts").get<long>());
    EXPECT_GT(lines, 1);
    EXPECT_FALSE(fs::exists(scratch_ / "without" / "impacts.csv"));
    EXPECT_EQ(state_hash_of(scratch_ / "with"), state_hash_of(scratch_ / "without")) << "looking changes nothing";
}

TEST_F(Run, DrawsFramesUnlessToldNotTo) {
    scratch_.write("three.toml", replaced(k_three_disks, "frames = { every = 0.0 }", "frames = { every = 0.025 }"));
    ASSERT_EQ(run({"three.toml", "-o", "with"}).exit_code, 0);
    ASSERT_EQ(run({"three.toml", "-o", "without", "--no-frames"}).exit_code, 0);
    for (const char* frame : {"000000.png", "000001.png", "000002.png"}) {
        EXPECT_TRUE(fs::exists(scratch_ / "with" / "frames" / frame)) << frame;
    }
    EXPECT_FALSE(fs::exists(scratch_ / "with" / "frames" / "000003.png"));
    EXPECT_FALSE(fs::exists(scratch_ / "without" / "frames"));
    const Outcome sheet = run_polargrain({"sheet", "with"}, scratch_.path());
    EXPECT_EQ(sheet.exit_code, 0) << sheet.err;
    EXPECT_TRUE(fs::exists(scratch_ / "with" / "sheet.png"));
    EXPECT_EQ(run_polargrain({"sheet", "with"}, scratch_.path()).exit_code, 2) << "nothing is overwritten";
    EXPECT_EQ(run_polargrain({"sheet", "without"}, scratch_.path()).exit_code, 0) << "drawn from the trajectory";
}

TEST_F(Run, WarnsOfATimeStepBeyondTheCriticalOne) {
    scratch_.write("three.toml", k_three_disks);
    const Outcome outcome = run({"three.toml", "--set", "run.time_step=0.02"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("warning"));
}

class Interrupt : public Run, public testing::WithParamInterface<int> {};

TEST_P(Interrupt, EndsTheRunCleanlyWithWhatWasComputedSoFar) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    RunningProgram program({"run", "long.toml", "-o", "long"}, scratch_.path());
    // The first row of the series is written when the loop is about to start.
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (read_file(scratch_ / "long" / "series.csv").empty() && std::chrono::steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    program.send(GetParam());
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    EXPECT_THAT(outcome.err, HasSubstr("polargrain resume long")) << "says how to go on";
    const nlohmann::json summary = summary_of(scratch_ / "long");
    EXPECT_EQ(summary.at("interrupted"), true);
    EXPECT_GT(summary.at("steps").get<long>(), 0);
    const std::string series = read_file(scratch_ / "long" / "series.csv");
    const std::string last_row = series.substr(series.rfind('\n', series.size() - 2) + 1);
    EXPECT_EQ(std::stod(last_row), summary.at("simulated_seconds").get<double>()) << "the last state was written";
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_F(Run, GoesOnWithoutItsTerminalWhereThatIsAskedFor) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup does
    RunningProgram program({"run", "long.toml", "-o", "long"}, scratch_.path());
    ASSERT_TRUE(wait_for(scratch_ / "long" / "checkpoint.h5"));
    std::signal(SIGHUP, before);
    program.send(SIGHUP);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_FALSE(fs::exists(scratch_ / "long" / "summary.json"));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().exit_code, 130);
}

class ShippedScenario : public Run, public testing::WithParamInterface<fs::path> {};

TEST_P(ShippedScenario, RunsForSomeSteps) {
    const std::string name = GetParam().stem();
    const Outcome outcome = run({name, "--set", "run.duration=0.01", "--set", "output.frames.every=0.01"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(scratch_ / "out" / name / "frames" / "000001.png"));
    EXPECT_GT(summary_of(scratch_ / "out" / name).at("steps").get<long>(), 1);
}

TEST_P(ShippedScenario, IsChecked) {
    const Outcome outcome = run_polargrain({"check", GetParam().string()}, scratch_.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("time step"));
    EXPECT_TRUE(fs::is_empty(scratch_.path())) << "check writes nothing";
}

std::vector<fs::path> shipped() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(POLARGRAIN_SOURCE_DIR "/scenarios")) {
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScenario, testing::ValuesIn(shipped()), [](const auto& scenario) {
    std::string name = scenario.param.stem();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace polargrain
