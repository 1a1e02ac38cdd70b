#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "src/record/claimed_file.h"
#include "src/record/folder_lock.h"
#include "tests/cli/recorded_run.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string drawn_and_shaken() {
    std::string text = replaced(k_three_disks, "frames = { every = 0.0 }", "frames = { every = 0.01, width = 320 }");
    // A wall that moves: its reach belongs to the view.
    return replaced(text, "points = [[-1.0, 0.0], [1.0, 0.0]]\n",
                    "points = [[-0.1, 0.0], [0.2, 0.0]]\n"
                    "motion = { type = \"sine\", direction = [0, 1], amplitude = 5e-3, frequency = 20.0 }\n");
}

const bool k_ffmpeg = std::system("ffmpeg -version > /dev/null 2>&1") == 0;

class Render : public RecordedRun {
protected:
    Render() : RecordedRun(drawn_and_shaken()) {}
};

TEST_F(Render, DrawsTheSamePicturesAsTheRunDid) {
    const Outcome outcome = polargrain({"render", "run", "-o", "again"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("6 frames: again"));
    for (const auto& entry : fs::directory_iterator(scratch_ / "run" / "frames")) {
        const std::string file = entry.path().filename();
        EXPECT_TRUE(read_file(scratch_ / "again" / file) == read_file(entry.path())) << file;
    }
}

TEST_F(Render, ShowsEveryQuantity) {
    std::vector<std::string> pictures;
    for (const char* colour :
         {"speed", "spin", "angle", "kinetic_energy", "size", "id", "shape", "material", "contacts", "force", "none"}) {
        const Outcome outcome = polargrain(
            {"render", "run", "--colour", std::string("by=") + colour, "--from", "0.03", "--to", "0.03", "--quiet"});
        EXPECT_EQ(outcome.exit_code, 0) << colour << ": " << outcome.err;
        pictures.push_back(read_file(scratch_ / "run" / (std::string("frames-") + colour) / "000000.png"));
        EXPECT_FALSE(pictures.back().empty()) << colour;
    }
    std::sort(pictures.begin(), pictures.end());
    EXPECT_EQ(std::unique(pictures.begin(), pictures.end()), pictures.end()) << "each in its own way";
    const Outcome wrong = polargrain({"render", "run", "--colour", "by=sped"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("the nearest is \"speed\""));
}

TEST_F(Render, TakesTheFramesThatAreAskedFor) {
    ASSERT_EQ(polargrain({"render", "run", "-o", "some", "--every", "2", "--from", "0.01"}).exit_code, 0);
    EXPECT_EQ(files_in("some"), 4) << "0.01, 0.03, 0.05 s and the index";
    const Outcome none = polargrain({"render", "run", "-o", "none", "--from", "7"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("from 0 s to 0.05 s"));
    EXPECT_FALSE(fs::exists(scratch_ / "none"));
}

TEST_F(Render, LeavesAFolderAloneInWhichAnotherDraws) {
    fs::create_directory(scratch_ / "drawn");
    scratch_.write("drawn/000000.png", "of another");
    const FolderLock lock(scratch_ / "drawn");
    const Outcome refused = polargrain({"render", "run", "-o", "drawn", "--force"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("drawn: another polargrain is running in this folder"));
    EXPECT_EQ(read_file(scratch_ / "drawn" / "000000.png"), "of another");
}

TEST_F(Render, WritesVectors) {
    ASSERT_EQ(polargrain({"render", "run", "-o", "v", "--format", "svg", "--every", "5"}).exit_code, 0);
    EXPECT_THAT(read_file(scratch_ / "v" / "000000.svg"), HasSubstr("<svg"));
}

TEST_F(Render, WritesMoviesWhereFfmpegIsInstalled) {
    if (!k_ffmpeg) GTEST_SKIP() << "ffmpeg is not installed";
    for (const char* name : {"one.mp4", "two.mp4"}) {
        const Outcome movie = polargrain({"render", "run", "-o", name, "--size", "320x200"});
        ASSERT_EQ(movie.exit_code, 0) << movie.err;
    }
    const std::string movie = read_file(scratch_ / "one.mp4");
    EXPECT_THAT(movie.substr(0, 12), HasSubstr("ftyp"));
    EXPECT_TRUE(movie == read_file(scratch_ / "two.mp4")) << "equal frames, equal bytes";
    EXPECT_EQ(files_in("."), 4) << "the scenario, the run, two movies, and nothing else";
    const Outcome full = RunningProgram({"render", "run", "-o", "three.mp4"}, scratch_.path(), 2000).wait();
    EXPECT_EQ(full.exit_code, 1) << "half a movie";
    EXPECT_THAT(full.err, HasSubstr("three.mp4"));
    EXPECT_FALSE(fs::exists(scratch_ / "three.mp4"));
}

TEST_F(Render, OfAMovieLeavesFilesAloneWhoseNamesAreOnlyLikeItsOwn) {
    if (!k_ffmpeg) GTEST_SKIP() << "ffmpeg is not installed";
    for (const char* name : {"one.mp4.part", "one.mp4.log"}) scratch_.write(name, "mine");
    ASSERT_EQ(polargrain({"render", "run", "-o", "one.mp4", "--size", "320x200"}).exit_code, 0);
    for (const char* name : {"one.mp4.part", "one.mp4.log"}) EXPECT_EQ(read_file(scratch_ / name), "mine") << name;
    const std::string movie = read_file(scratch_ / "one.mp4");
    EXPECT_EQ(polargrain({"render", "run", "-o", "one.mp4"}).exit_code, 2) << "nothing is overwritten";
    EXPECT_TRUE(read_file(scratch_ / "one.mp4") == movie);
    EXPECT_EQ(polargrain({"render", "run", "-o", "one.mp4", "--force"}).exit_code, 0);
    EXPECT_FALSE(read_file(scratch_ / "one.mp4") == movie);
}

TEST_F(Render, LeavesAMovieAloneThatAnotherDraws) {
    if (!k_ffmpeg) GTEST_SKIP() << "ffmpeg is not installed";
    {
        const ClaimedFile claim(scratch_ / "one.mp4", false);
        const Outcome refused = polargrain({"render", "run", "-o", "one.mp4", "--force"});
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr("one.mp4: another polargrain is writing this file"));
        EXPECT_EQ(files_in("."), 3);
    }
    EXPECT_FALSE(fs::exists(scratch_ / "one.mp4")) << "nothing came of it";
}

TEST_F(Render, OfAMovieThatIsInterruptedLeavesNothing) {
    if (!k_ffmpeg) GTEST_SKIP() << "ffmpeg is not installed";
    RunningProgram program({"render", "run", "-o", "one.mp4", "--size", "8000x4000"}, scratch_.path());
    ASSERT_TRUE(wait_for(scratch_ / "one.mp4"));
    program.send_to_all(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    EXPECT_EQ(files_in("."), 2) << "the scenario and the run";
}

TEST_F(Render, SaysWhatAMovieNeeds) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const Outcome refused = polargrain({"render", "run", "-o", "movie.mp4"});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("apt-get install ffmpeg"));
    EXPECT_FALSE(fs::exists(scratch_ / "movie.mp4"));
}

TEST_F(Render, OfARunInProgressSaysSoAndWhatToDo) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    RunningProgram program({"run", "long.toml", "-o", "long"}, scratch_.path());
    ASSERT_TRUE(wait_for(scratch_ / "long" / "checkpoint.h5"));
    for (const char* command : {"render", "sheet"}) {
        const Outcome refused = polargrain({command, "long"});
        EXPECT_EQ(refused.exit_code, 2) << command;
        EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("long: the run in this folder is in progress"),
                                                HasSubstr("polargrain resume long")));
    }
    program.send(SIGKILL);
    program.wait();
    EXPECT_EQ(polargrain({"render", "long"}).exit_code, 0) << "afterwards it is drawn as far as it came";
}

TEST_F(Render, OfADamagedRecordingIsRefusedByName) {
    const std::string good = read_file(scratch_ / "run" / "trajectory.h5");
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, good.size() / 2}) {
        scratch_.write("run/trajectory.h5", good.substr(0, length));
        const Outcome refused = polargrain({"render", "run", "-o", "again"});
        EXPECT_EQ(refused.exit_code, 2) << length;
        EXPECT_THAT(refused.err, HasSubstr("run/trajectory.h5: is damaged"));
        EXPECT_FALSE(fs::exists(scratch_ / "again"));
    }
}

TEST_F(Render, RefusesNumbersThatAreNone) {
    const struct {
        const char *option, *value, *says;
    } mistakes[] = {{"--colour-max", "nan", "nan is no end of a colour scale; give a number from 1e-09 to 1e+09"},
                    {"--colour-max", "inf", "1e+09"},
                    {"--colour-max", "-1", "1e+09"},
                    {"--colour-max", "1e999", "1e+09"},
                    {"--fps", "nan", "nan is no number of frames per second; give a number from 0.1 to 240"},
                    {"--fps", "inf", "from 0.1 to 240"},
                    {"--fps", "-3", "from 0.1 to 240"},
                    {"--from", "nan", "nan is no time"},
                    {"--to", "soon", "soon is no time"},
                    {"--every", "0", "0 is no number of frames; give a whole number from 1"}};
    for (const auto& [option, value, says] : mistakes) {
        const Outcome refused = polargrain({"render", "run", "-o", "again", option, value});
        EXPECT_EQ(refused.exit_code, 2) << option << " " << value;
        EXPECT_THAT(refused.err, testing::AllOf(HasSubstr(option), HasSubstr(says)));
        EXPECT_FALSE(fs::exists(scratch_ / "again"));
    }
}

TEST_F(Render, MakesTheFoldersAboveWhatIsDrawn) {
    using Words = std::vector<std::string>;
    std::vector<Words> all{{"plot", "run", "-o", "new/er/plot"}, {"sheet", "run", "-o", "new/est/sheet.png"}};
    if (k_ffmpeg) all.push_back({"render", "run", "-o", "new/movie.mp4", "--size", "320x200"});
    for (const Words& words : all) {
        const Outcome outcome = polargrain(words);
        EXPECT_EQ(outcome.exit_code, 0) << words[0] << ": " << outcome.err;
    }
    for (const char* file : {"new/er/plot.png", "new/est/sheet.png"}) EXPECT_TRUE(fs::exists(scratch_ / file)) << file;
    for (Words words : all) {
        words[3] = "three.toml/x.mp4";
        const Outcome refused = polargrain(words);
        EXPECT_EQ(refused.exit_code, 2) << words[0];
        EXPECT_THAT(refused.err, HasSubstr("three.toml is a file; give another folder with -o"));
    }
}

TEST_F(Render, NeverReplacesAFileOfTheRun) {
    fs::create_symlink("run/trajectory.h5", scratch_ / "link.h5");
    const std::string recording = read_file(scratch_ / "run" / "trajectory.h5");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", "run", "--format", "mp4", "-o", "run/trajectory.h5"},
          {"render", "run", "--format", "mp4", "-o", "link.h5"},
          {"render", "run", "--format", "mp4", "-o", "run/../run/series.csv"},
          {"sheet", "run", "-o", "run/trajectory.h5"}}) {
        std::vector<std::string> forced = words;
        forced.emplace_back("--force");
        const Outcome refused = polargrain(forced);
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr(words.back() + ": is a file of the run itself"));
        EXPECT_TRUE(read_file(scratch_ / "run" / "trajectory.h5") == recording);
    }
}

TEST_F(Render, RefusesNamesThatPromiseAnotherFormat) {
    using Words = std::vector<std::string>;
    for (const Words& output : {Words{"-o", "x.avi"},
                                {"-o", "x.png"},
                                {"-o", "Y.AVI"},
                                {"-o", "y.webp"},
                                {"-o", "y.tif"},
                                {"-o", "y.tiff"},
                                {"-o", "y.Bmp"},
                                {"-o", "x.mp4", "--format", "svg"},
                                {"-o", "x.gif", "--format", "mp4"}}) {
        Words words{"render", "run"};
        words.insert(words.end(), output.begin(), output.end());
        const Outcome refused = polargrain(words);
        EXPECT_EQ(refused.exit_code, 2) << output[1];
        EXPECT_THAT(refused.err, testing::AllOf(HasSubstr(output[1]), HasSubstr("ends in .mp4")));
        EXPECT_FALSE(fs::exists(scratch_ / output[1]));
    }
    EXPECT_EQ(polargrain({"render", "run", "-o", "with.dot"}).exit_code, 0);
    if (!k_ffmpeg) GTEST_SKIP() << "ffmpeg is not installed";
    EXPECT_EQ(polargrain({"render", "run", "-o", "B.MP4", "--size", "320x200"}).exit_code, 0);
    EXPECT_TRUE(fs::is_regular_file(scratch_ / "B.MP4"));
}

TEST_F(Render, RefusesToOverwriteAndWrongSizes) {
    ASSERT_EQ(polargrain({"render", "run", "-o", "v"}).exit_code, 0);
    EXPECT_EQ(polargrain({"render", "run", "-o", "v"}).exit_code, 2);
    scratch_.write("v/mine.txt", "mine");
    EXPECT_EQ(polargrain({"render", "run", "-o", "v", "--force", "--every", "5"}).exit_code, 0);
    EXPECT_EQ(files_in("v"), 4) << "two frames, the index, and what is not ours";
    for (const char* size : {"12", "320x", "x200", "320x200x3", "1x1", "320 x 200"}) {
        const Outcome wrong = polargrain({"render", "run", "-o", "w", "--size", size});
        EXPECT_EQ(wrong.exit_code, 2) << size;
        EXPECT_THAT(wrong.err, HasSubstr("1280x720"));
    }
    EXPECT_EQ(polargrain({"render", "nowhere"}).exit_code, 2);
}

}  // namespace
}  // namespace polargrain
