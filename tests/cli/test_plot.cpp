#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/recorded_run.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class PlotCommand : public RecordedRun {
protected:
    PlotCommand() : RecordedRun(k_three_disks) {}
};

TEST_F(PlotCommand, DrawsTheSeriesOfARun) {
    const Outcome outcome = polargrain({"plot", "run"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("run/plot.png"));
    EXPECT_THAT(outcome.out, HasSubstr("zero throughout: "));
    for (const char* file : {"plot.png", "plot.pdf", "plot.csv"}) {
        EXPECT_GT(fs::file_size(scratch_ / "run" / file), 500U) << file;
    }
    EXPECT_EQ(polargrain({"plot", "run"}).exit_code, 2) << "nothing is overwritten";
    EXPECT_EQ(polargrain({"plot", "run", "--force"}).exit_code, 0);
}

TEST_F(PlotCommand, DrawsWhatIsAskedForUnderAnyName) {
    const Outcome outcome = polargrain({"plot", "run", "-o", "energy", "--columns", "potential,kinetic_rotational"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(read_file(scratch_ / "energy.csv"), HasSubstr("potential"));
    EXPECT_THAT(read_file(scratch_ / "energy.csv"), Not(HasSubstr("impacts")));
}

TEST_F(PlotCommand, LeavesFilesAloneWhoseNamesAreOnlyLikeItsOwn) {
    for (const char* name : {"energy.gnuplot", "energy.gnuplot.log"}) scratch_.write(name, "mine");
    ASSERT_EQ(polargrain({"plot", "run", "-o", "energy"}).exit_code, 0);
    for (const char* name : {"energy.gnuplot", "energy.gnuplot.log"}) EXPECT_EQ(read_file(scratch_ / name), "mine");
    EXPECT_EQ(files_in("."), 7) << "these, the scenario, the run, and the plot";
}

TEST_F(PlotCommand, RefusesAFolderInPlaceOfAName) {
    fs::create_directories(scratch_ / "d");
    for (const char* folder : {"d/", ".", "d/..", "new/"}) {
        const Outcome refused = polargrain({"plot", "run", "-o", folder});
        EXPECT_EQ(refused.exit_code, 2) << folder;
        EXPECT_THAT(refused.err, HasSubstr("is a folder; give the files a name in it"));
    }
    EXPECT_THAT(polargrain({"plot", "run", "-o", "d/"}).err, HasSubstr("-o d/plot"));
    EXPECT_TRUE(fs::is_empty(scratch_ / "d"));
    EXPECT_EQ(files_in("."), 3);
}

TEST_F(PlotCommand, NeverReplacesTheSeriesItself) {
    const std::string series = read_file(scratch_ / "run/series.csv");
    EXPECT_EQ(polargrain({"plot", "run", "-o", "run/series", "--force"}).exit_code, 2);
    EXPECT_EQ(polargrain({"plot", "run", "-o", "run/../run/series", "--force"}).exit_code, 2);
    EXPECT_EQ(read_file(scratch_ / "run/series.csv"), series);
    scratch_.write("run/impacts.csv", "of the run");
    EXPECT_EQ(polargrain({"plot", "run", "-o", "run/impacts", "--force"}).exit_code, 2);
    EXPECT_EQ(read_file(scratch_ / "run/impacts.csv"), "of the run");
}

TEST_F(PlotCommand, TakesTimesThatAreOffByRoundingAsExportDoes) {
    ASSERT_EQ(polargrain({"run", "three.toml", "-o", "round", "--no-frames", "--set", "run.time_step=1e-3", "--set",
                          "output.series.every=1e-3", "--set", "output.trajectory.every=1e-3"})
                  .exit_code,
              0);
    ASSERT_THAT(read_file(scratch_ / "round/series.csv"), HasSubstr("0.009000000000000001,"));
    const struct {
        const char *from, *to;
        int taken;
    } cases[] = {{"0", "0.009", 10}, {"0.009", "0.009", 1}, {"0.0005", "0.021", 21}, {"0.0091", "0.0109", 1}};
    for (const auto& [from, to, taken] : cases) {
        const Outcome plot = polargrain(
            {"plot", "round", "-o", "part", "--columns", "potential", "--from", from, "--to", to, "--force"});
        ASSERT_EQ(plot.exit_code, 0) << plot.err;
        const std::string rows = read_file(scratch_ / "part.csv");
        EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + taken) << from << " to " << to;
        const Outcome exported = polargrain({"export", "round", "-o", "part", "--from", from, "--to", to, "--force"});
        EXPECT_THAT(exported.out, HasSubstr(std::to_string(taken) + " frames")) << from << " to " << to;
    }
}

TEST_F(PlotCommand, TakesRowsThatWereDueAtTheLastTime) {
    // No step ends at 0.03 s: the sample is taken at the next.
    ASSERT_EQ(polargrain({"run", "three.toml", "-o", "late", "--no-frames", "--set", "run.time_step=7e-4"}).exit_code,
              0);
    for (const char* command : {"plot", "export"}) {
        const Outcome outcome = polargrain({command, "late", "-o", command, "--from", "0.03", "--to", "0.03"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
}

TEST_F(PlotCommand, SaysWhatToDoWithoutASeries) {
    ASSERT_EQ(
        polargrain({"run", "three.toml", "-o", "bare", "--no-frames", "--set", "output.series.every=0"}).exit_code, 0);
    const Outcome outcome = polargrain({"plot", "bare"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("bare: has no series.csv; run it with --set output.series.every=0.01"));
}

}  // namespace
}  // namespace polargrain
