#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "src/record/folder_lock.h"
#include "src/record/trajectory_h5.h"
#include "tests/cli/recorded_run.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ExportCommand : public RecordedRun {
protected:
    ExportCommand() : RecordedRun(k_three_disks) {}
};

TEST_F(ExportCommand, FillsAFolderOfTheRunFolderUnlessToldOtherwise) {
    const Outcome outcome = polargrain({"export", "run"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("6 frames: run/export"));
    for (const char* series : {"grains", "contacts", "walls"}) {
        EXPECT_TRUE(fs::exists(scratch_ / "run" / "export" / (std::string(series) + ".pvd"))) << series;
        EXPECT_EQ(files_in(std::string("run/export/") + series), 6) << series;
    }
    EXPECT_EQ(files_in("run/export"), 6) << "nothing else";
}

TEST_F(ExportCommand, TakesRunsOfDominoesAndOfRoughGrains) {
    for (const char* scenario : {"domino-opalene", "bin-rough", "falling-star"}) {
        ASSERT_EQ(polargrain({"run", scenario, "-o", scenario, "--no-frames", "--set", "run.duration=0.01", "--set",
                              "settle.at_most=0.01", "--quiet"})
                      .exit_code,
                  0);
        const Outcome outcome = polargrain({"export", scenario, "--format", "vtk,csv", "--quiet"});
        EXPECT_EQ(outcome.exit_code, 0) << scenario << ": " << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(files_in(std::string(scenario) + "/export"), 7) << "three collections, their folders, the table";
    }
}

TEST_F(ExportCommand, TakesTheFramesThatAreAskedFor) {
    ASSERT_EQ(polargrain({"export", "run", "-o", "some", "--every", "2", "--from", "0.01", "--to", "0.04"}).exit_code,
              0);
    EXPECT_EQ(files_in("some/grains"), 2) << "0.01 and 0.03 s";
    const Outcome none = polargrain({"export", "run", "-o", "none", "--from", "7"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("from 0 s to 0.05 s"));
    EXPECT_FALSE(fs::exists(scratch_ / "none"));
}

TEST_F(ExportCommand, WritesATableOfTheGrains) {
    ASSERT_EQ(polargrain({"export", "run", "-o", "table", "--format", "csv"}).exit_code, 0);
    EXPECT_EQ(files_in("table"), 1);
    const std::string table = read_file(scratch_ / "table" / "grains.csv");
    EXPECT_THAT(table, testing::StartsWith("time,step,grain,x,y,angle,vx,vy,spin\n0,0,0,0,0.011,0,1,0,0\n"));
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 6 * 3);
}

TEST_F(ExportCommand, ReplacesNothingUnlessForcedAndThenOnlyAnExport) {
    ASSERT_EQ(polargrain({"export", "run", "-o", "e", "--format", "vtk,csv"}).exit_code, 0);
    const Outcome refused = polargrain({"export", "run", "-o", "e", "--every", "5"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("e: is there already"), HasSubstr("-o"), HasSubstr("--force")));
    EXPECT_EQ(files_in("e/grains"), 6);
    scratch_.write("e/mine.txt", "mine");
    scratch_.write("e/grains/mine.vtp", "mine");
    ASSERT_EQ(polargrain({"export", "run", "-o", "e", "--every", "5", "--force"}).exit_code, 0);
    EXPECT_EQ(files_in("e/grains"), 3) << "two frames, and what is not ours";
    EXPECT_FALSE(fs::exists(scratch_ / "e" / "grains.csv")) << "nothing of the former export is left";
    EXPECT_EQ(read_file(scratch_ / "e" / "mine.txt"), "mine");
    ASSERT_EQ(polargrain({"export", "run", "-o", "e", "--format", "csv", "--force"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(scratch_ / "e" / "walls")) << "an empty folder is left out";
    EXPECT_EQ(read_file(scratch_ / "e" / "grains" / "mine.vtp"), "mine");
}

TEST_F(ExportCommand, RefusesPlacesThatAreNone) {
    scratch_.write("file", "mine");
    const Outcome refused = polargrain({"export", "run", "-o", "file", "--force"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("file"));
    EXPECT_EQ(read_file(scratch_ / "file"), "mine");
    fs::create_directory(scratch_ / "taken");
    const FolderLock lock(scratch_ / "taken");
    EXPECT_THAT(polargrain({"export", "run", "-o", "taken"}).err, HasSubstr("another polargrain is running"));
    EXPECT_TRUE(fs::is_empty(scratch_ / "taken"));
}

TEST_F(ExportCommand, HalfOfAnExportIsNotTakenForAWholeOne) {
    const std::vector<std::string> words = {"export", "run", "-o", "half", "--format", "vtk,csv"};
    // Table and frames of three disks are larger than that.
    const Outcome full = RunningProgram(words, scratch_.path(), 1000).wait();
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_THAT(full.err, HasSubstr("half/grains/000000.vtp: cannot"));
    for (const char* name : {"grains.pvd", "contacts.pvd", "walls.pvd", "grains.csv"}) {
        EXPECT_FALSE(fs::exists(scratch_ / "half" / name)) << name;
    }
    EXPECT_EQ(polargrain(words).exit_code, 2);
    std::vector<std::string> forced = words;
    forced.emplace_back("--force");
    EXPECT_EQ(polargrain(forced).exit_code, 0);
    EXPECT_EQ(files_in("half"), 7);
}

TEST_F(ExportCommand, OfWhatIsNoRunSaysSo) {
    EXPECT_THAT(polargrain({"export", "nowhere"}).err, HasSubstr("nowhere: no such run folder"));
    fs::create_directory(scratch_ / "empty");
    const Outcome empty = polargrain({"export", "empty"});
    EXPECT_EQ(empty.exit_code, 2);
    EXPECT_THAT(empty.err, AllOf(HasSubstr("empty/trajectory.h5: no such file"), HasSubstr("trajectory is 0")));
    EXPECT_TRUE(fs::is_empty(scratch_ / "empty"));
    scratch_.write("bare.toml", replaced(k_three_disks, "trajectory = { every = 0.01 }", "trajectory = { every = 0 }"));
    ASSERT_EQ(polargrain({"run", "bare.toml", "-o", "bare"}).exit_code, 0);
    EXPECT_THAT(polargrain({"export", "bare"}).err, HasSubstr("bare/trajectory.h5: no such file"));
}

TEST_F(ExportCommand, OfADamagedRecordingIsRefusedByName) {
    const std::string good = read_file(scratch_ / "run" / "trajectory.h5");
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, good.size() / 2}) {
        scratch_.write("run/trajectory.h5", good.substr(0, length));
        const Outcome refused = polargrain({"export", "run"});
        EXPECT_EQ(refused.exit_code, 2) << length;
        EXPECT_THAT(refused.err, HasSubstr("run/trajectory.h5: is damaged"));
        EXPECT_FALSE(fs::exists(scratch_ / "run" / "export"));
    }
}

TEST_F(ExportCommand, OfARecordingWithoutAFrameSaysSo) {
    fs::create_directory(scratch_ / "young");
    TrajectoryH5 trajectory(scratch_ / "young" / "trajectory.h5", 0.1, {});
    trajectory.begin(Scene{}, RunInfo{});
    trajectory.end();
    for (const char* command : {"export", "render", "sheet"}) {
        const Outcome refused = polargrain({command, "young"});
        EXPECT_EQ(refused.exit_code, 2) << command;
        EXPECT_THAT(refused.err, HasSubstr("young/trajectory.h5: holds no frame yet"));
    }
}

TEST_F(ExportCommand, OfARunInProgressSaysSoAndWhatToDo) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    RunningProgram program({"run", "long.toml", "-o", "long"}, scratch_.path());
    ASSERT_TRUE(wait_for(scratch_ / "long" / "checkpoint.h5"));
    const Outcome refused = polargrain({"export", "long"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err,
                AllOf(HasSubstr("long: the run in this folder is in progress"), HasSubstr("polargrain resume long")));
    program.send(SIGKILL);
    program.wait();
}

TEST_F(ExportCommand, RefusesOptionsThatAreNone) {
    const struct {
        const char *option, *value, *says;
    } mistakes[] = {{"--format", "xyz", "xyz"},
                    {"--format", "vtk,xyz", "xyz"},
                    {"--sides", "2", "2 is no number of sides; give a whole number from 3 to 1024"},
                    {"--every", "0", "0 is no number of frames"},
                    {"--from", "soon", "soon is no time"}};
    for (const auto& [option, value, says] : mistakes) {
        const Outcome refused = polargrain({"export", "run", "-o", "e", option, value});
        EXPECT_EQ(refused.exit_code, 2) << option << " " << value;
        EXPECT_THAT(refused.err, AllOf(HasSubstr(option), HasSubstr(says)));
        EXPECT_FALSE(fs::exists(scratch_ / "e"));
    }
}

}  // namespace
}  // namespace polargrain
