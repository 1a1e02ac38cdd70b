#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <ostream>
#include <sstream>
#include <string>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Outcome run(const std::vector<std::string>& arguments) {
    const ScratchFolder scratch;
    Outcome outcome = run_polargrain(arguments, scratch.path());
    EXPECT_TRUE(fs::is_empty(scratch.path())) << "nothing is left behind";
    return outcome;
}

TEST(CommandLine, HelpOfEveryCommandHasExamples) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"run", "--help"},
                                                      {"resume", "--help"},
                                                      {"render", "--help"},
                                                      {"export", "--help"},
                                                      {"sweep", "--help"},
                                                      {"check", "--help"},
                                                      {"shape", "--help"},
                                                      {"list", "--help"},
                                                      {"sheet", "--help"},
                                                      {"plot", "--help"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << arguments[0];
        EXPECT_THAT(outcome.out, HasSubstr("Examples:\n  polargrain " + (arguments.size() > 1 ? arguments[0] : "")));
    }
}

TEST(CommandLine, VersionTellsHowItWasBuilt) {
    const Outcome outcome = run({"--version"});
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* part : {"polargrain ", "-ffp-contract=off", "Eigen 3", "HDF5 1", "toml++ 3"}) {
        EXPECT_THAT(outcome.out, HasSubstr(part));
    }
}

TEST(CommandLine, EnginesOfTheProgramAreThoseOfScenarioFiles) {
    std::istringstream lines(run({"list", "engines"}).out);
    std::string line, name;
    std::getline(lines, line);
    std::string names;
    while (std::getline(lines, line) && std::istringstream(line) >> name) {
        EXPECT_EQ(run({"check", "fig9", "--engine", name}).exit_code, 0) << name;
        names += (names.empty() ? "" : ", ") + name;
    }
    EXPECT_THAT(names, HasSubstr("contact"));
    EXPECT_THAT(run({"check", "fig9", "--engine", "nosuch"}).err, HasSubstr(names + "\n"));
}

TEST(CommandLine, MistakesEndWithTwoAndAHint) {
    const struct {
        std::vector<std::string> arguments;
        const char* says;
    } mistakes[] = {
        {{}, "Examples"},
        {{"rum", "x.toml"}, "did you mean run?"},
        {{"run", "fig9", "--forse"}, "did you mean --force?"},
        {{"run"}, "SCENARIO"},
        {{"list", "planets"}, "planets"},
        {{"run", "fig9", "--seed", "many"}, "seed"},
        {{"run", "fig9", "--seed", "-1"}, "--seed: -1 is no seed; give a whole number from 0 to 9007199254740992"},
        {{"run", "fig9", "--threads", "0"}, "--threads: 0 is no number of threads; give a whole number from 1 to 1024"},
        {{"run", "fig9", "--threads", "nan"}, "nan is no number of threads"},
        {{"run", "domino-opalen"}, "domino-opalene"},
        {{"run", "fig9", "--engine", "contact-1995"}, "contact-1994"},
        {{"run", "fig9", "--set", "run.duraton=1"}, "duration"},
        {{"run", "fig9", "--set", "run.duration"}, "run.duration"},
        {{"check", "absent.toml"}, "absent.toml"},
        {{"check", "/tmp"}, "/tmp: is a folder; name a scenario file in it"},
        {{"check", ""}, "SCENARIO: is empty"},
        {{"run", "fig9", "-o", ""}, "--output: is empty"},
        {{"sweep", "/dev/zero"}, "/dev/zero: there is no such sweep file"},
        {{"shape", "gearr"}, "gear"},
        {{"sheet", "no-such-folder"}, "no-such-folder"},
        {{"plot", "no-such-folder"}, "no-such-folder"},
    };
    for (const auto& [arguments, says] : mistakes) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << says << "\n" << outcome.out;
        EXPECT_THAT(outcome.err, HasSubstr(says));
    }
}

TEST(CommandLine, OutputThatIsLostFailsAndAnErrorThatNobodyCanReadIsStillThatError) {
    const ScratchFolder scratch;
    const auto exit_code = [&](const std::string& rest) {
        const int status =
            std::system(("cd " + scratch.path().string() + " && " POLARGRAIN_BINARY_DIR "/polargrain " + rest).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    for (const char* command : {"check fig9", "list", "--help", "--version", "shape gear"}) {
        EXPECT_EQ(exit_code(std::string(command) + " >/dev/full 2>/dev/null"), 1) << command;
    }
    EXPECT_EQ(exit_code("check nosuch 2>/dev/full"), 2);
    EXPECT_EQ(exit_code("list --nosuch 2>/dev/full"), 2);
    EXPECT_EQ(exit_code("check nosuch >/dev/full 2>/dev/full"), 2);
}

TEST(CommandLine, ListsWhatIsThere) {
    EXPECT_THAT(run({"list"}).out,
                testing::AllOf(HasSubstr("domino-opalene"), HasSubstr("gear"), HasSubstr("contact-1994")));
    const Outcome engines = run({"list", "engines"});
    EXPECT_THAT(engines.out, HasSubstr("contact-1994"));
    EXPECT_THAT(engines.out, testing::Not(HasSubstr("domino-opalene")));
}

TEST(CommandLine, AFolderThatTheSystemRefusesIsNamedWithItsReason) {
    const std::string name(300, 'a');
    const Outcome outcome = run({"run", "fig9", "-o", name});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("error: " + name + ": a name of more than 255 bytes;"));
}

TEST(CommandLine, AnOutlineThatIsNoGrainIsNamedByItsFile) {
    const ScratchFolder scratch;
    scratch.write("bow.toml", "title = \"bow tie\"\nsource = \"made up\"\npoints = [[0, 0], [1, 1], [1, 0], [0, 1]]\n");
    const Outcome outcome = run_polargrain({"shape", "bow.toml"}, scratch.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("bow.toml: "));
}

TEST(CommandLine, MeasuresAndDrawsAShape) {
    const ScratchFolder scratch;
    const Outcome outcome = run_polargrain({"shape", "domino", "-o", "domino.png"}, scratch.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("0.0003135 m^2")) << "41.8 mm x 7.5 mm";
    EXPECT_THAT(outcome.out, testing::ContainsRegex("convex +yes"));
    EXPECT_EQ(read_file(scratch / "domino.png").substr(1, 3), "PNG");
    EXPECT_EQ(run_polargrain({"shape", "domino", "-o", "domino.png"}, scratch.path()).exit_code, 2)
        << "nothing is overwritten";
    EXPECT_THAT(run({"shape", "gear"}).out, testing::ContainsRegex("convex +no"));
}

struct BrokenFile {
    const char* name;
    std::string text;
    const char* says;
};

void PrintTo(const BrokenFile& file, std::ostream* out) { *out << file.name; }

class Broken : public testing::TestWithParam<BrokenFile> {};

TEST_P(Broken, IsRefusedWithItsPlaceAndLeavesNoFolder) {
    const ScratchFolder scratch;
    scratch.write("broken.toml", GetParam().text);
    const Outcome outcome = run_polargrain({"run", "broken.toml", "-o", "left"}, scratch.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().says));
    EXPECT_THAT(outcome.err, HasSubstr("broken.toml"));
    EXPECT_FALSE(fs::exists(scratch / "left"));
    EXPECT_EQ(run_polargrain({"check", "broken.toml"}, scratch.path()).exit_code, 2);
}

BrokenFile changed(const char* name, const char* piece, const char* by, const char* says) {
    return {name, replaced(k_three_disks, piece, by), says};
}

INSTANTIATE_TEST_SUITE_P(
    Files, Broken,
    testing::Values(BrokenFile{"empty", "", "no grains"},
                    BrokenFile{"settle_without_gravity",
                               replaced(k_three_disks, "[materials", "gravity = 0.0\n[settle]\n[materials"), "gravity"},
                    BrokenFile{"no_toml", "title = = 3\n", ":1:"},
                    BrokenFile{"binary",
                               std::string("\x7f"
                                           "ELF\0\1\2",
                                           7),
                               ":1:"},
                    changed("unknown_key", "density", "densty", "density"),
                    changed("unknown_table", "[run]", "[runn]", "run"),
                    changed("wrong_type", "duration = 0.05", "duration = \"long\"", "duration"),
                    changed("too_often", "series = { every = 0.01 }", "series = { every = 1e-12 }", "every"),
                    changed("negative", "radius = 0.01", "radius = -0.01", "radius"),
                    changed("not_a_number", "density = 2000.0", "density = nan", "density"),
                    changed("restitution_above_one", "mean = 0.5", "mean = 1.5", "mean"),
                    changed("unknown_material", "material = \"stone\"", "material = \"ston\"", "stone"),
                    changed("unknown_shape", "shape = \"disk\"", "shape = \"dist\"", "disk"),
                    changed("overlap", "step = [0.025, 0.0]", "step = [0.015, 0.0]", "overlap"),
                    changed("in_the_floor", "start = [0.0, 0.011]", "start = [0.0, 0.005]", "floor"),
                    changed("missing_key", "radius = 0.01", "", "radius")),
    [](const auto& file) { return file.param.name; });

}  // namespace
}  // namespace polargrain
