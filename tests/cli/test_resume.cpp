#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "src/core/random.h"
#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;
using testing::HasSubstr;

/// Twelve non-convex grains that settle and are then let go, with every kind of output, and a checkpoint as often
/// as not.
const std::string k_everything = R"(title = "Everything at once"

[run]
duration = 0.012
time_step = 1e-4
seed = 5

[materials.stone]
density = 2000.0
restitution = { mean = 0.5, stddev = 0.1 }
friction = 0.3

[shapes.star]
type = "star"
radius = 0.006
inner_radius = 0.003
points = 5

[[walls]]
name = "box"
material = "stone"
points = [[0.0, 0.2], [0.0, 0.0], [0.03, 0.0]]

[[walls]]
name = "gate"
material = "stone"
points = [[0.03, 0.0], [0.06, 0.0], [0.06, 0.2]]
motion = { type = "sine", direction = [0, 1], amplitude = 1e-3, frequency = 50.0 }

[[walls]]
name = "plunger"
material = "stone"
points = [[0.06, 0.081], [0.0, 0.081]]
motion = { type = "linear", velocity = [0, -2.0], start = 0.00235, end = 0.00985 }

[[fill]]
count = 12
shapes = ["star"]
material = "stone"
region = [[0.0, 0.0], [0.06, 0.08]]

[settle]
until_energy = 1e-3
at_most = 0.006

[output]
frames = { every = 0.004, width = 64 }
trajectory = { every = 0.001 }
series = { every = 0.0005 }
impacts = true
checkpoint = { every_wall = 1e-3 }
)";

std::vector<std::string> engines() {
    const ScratchFolder scratch;
    std::istringstream lines(run_polargrain({"list", "engines"}, scratch.path()).out);
    std::vector<std::string> names;
    std::string line, name;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::istringstream(line) >> name;
        names.push_back(name);
    }
    return names;
}

/// Every file of a run folder by name, but for what differs from run to run: summary.json without the seconds it took,
/// and no checkpoint, which tells them too.
std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_directory() || entry.path().filename() == "checkpoint.h5") continue;
        std::string text = read_file(entry.path());
        if (entry.path().filename() == "summary.json") {
            nlohmann::json summary = nlohmann::json::parse(text);
            for (const char* key : {"cpu_seconds", "wall_seconds"}) summary.erase(key);
            text = summary.dump();
        }
        files[fs::relative(entry.path(), folder)] = text;
    }
    return files;
}

void expect_equal_files(const fs::path& folder, const std::map<std::string, std::string>& expected) {
    const auto files = files_of(folder);
    for (const auto& [name, text] : expected) {
        ASSERT_TRUE(files.contains(name)) << name << " is missing";
        EXPECT_TRUE(files.at(name) == text) << name << " differs";
    }
    for (const auto& [name, text] : files) EXPECT_TRUE(expected.contains(name)) << name << " is one too many";
}

/// Once, with an engine, without interruption: what it leaves behind and how long it takes.
struct Reference {
    Reference(const fs::path& scratch, const std::string& engine) {
        const auto begin = steady_clock::now();
        const Outcome outcome =
            run_polargrain({"run", "everything.toml", "-o", "whole", "--engine", engine, "--quiet"}, scratch);
        seconds = std::chrono::duration<double>(steady_clock::now() - begin).count();
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        files = files_of(scratch / "whole");
    }
    double seconds = 0.0;
    std::map<std::string, std::string> files;
};

class Resume : public testing::Test {
protected:
    Outcome polargrain(const std::vector<std::string>& arguments) const {
        return run_polargrain(arguments, scratch_.path());
    }
    std::map<std::string, std::string> folder(const std::string& name) const { return files_of(scratch_ / name); }

    ScratchFolder scratch_;
};

class ResumeAfterKill : public Resume, public testing::WithParamInterface<std::string> {};

TEST_P(ResumeAfterKill, AtThirtyRandomMomentsGivesTheSameFiles) {
    const std::string engine = GetParam();
    scratch_.write("everything.toml", k_everything);
    const Reference whole(scratch_.path(), engine);
    ASSERT_GE(whole.files.size(), 9U);

    const std::uint64_t seed = 20261122;
    RandomStream random(seed, RandomPurpose::test);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << whole.seconds << " s without interruption");
    const auto killed = [&](const std::vector<std::string>& arguments) {
        RunningProgram program(arguments, scratch_.path());
        std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0.0, whole.seconds)));
        program.send(SIGKILL);
        return program.wait().exit_code == -SIGKILL;
    };
    int kills = 0, while_writing = 0;
    while (kills < 30 || (while_writing == 0 && kills < 300)) {
        kills += killed({"run", "everything.toml", "-o", "cut", "--engine", engine, "--force", "--quiet"}) ? 1 : 0;
        if (!fs::exists(scratch_ / "cut" / "scenario.toml")) continue;  // killed before there was anything to resume
        for (int again = 0; again < 3; ++again) {
            while_writing += fs::exists(scratch_ / "cut" / "checkpoint.h5.part") ? 1 : 0;
            kills += killed({"resume", "cut", "--quiet"}) ? 1 : 0;
        }
        const Outcome resumed = polargrain({"resume", "cut", "--quiet"});
        ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
        expect_equal_files(scratch_ / "cut", whole.files);
        if (HasFailure()) return;
    }
    EXPECT_GT(while_writing, 0) << "some kills fall into the writing of a checkpoint";
}

INSTANTIATE_TEST_SUITE_P(Engines, ResumeAfterKill, testing::ValuesIn(engines()), [](const auto& engine) {
    std::string name = engine.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST_F(Resume, AfterCtrlCGivesTheSameFiles) {
    scratch_.write("everything.toml", k_everything);
    // Long enough not to be over before the signal comes, however slowly this test is served.
    const std::string lasting = "run.duration=0.5";
    ASSERT_EQ(polargrain({"run", "everything.toml", "-o", "whole", "--set", lasting, "--quiet"}).exit_code, 0);
    const auto whole = folder("whole");
    for (const char* after : {"scenario.toml", "checkpoint.h5", "frames/000003.png"}) {
        RunningProgram program({"run", "everything.toml", "-o", "cut", "--set", lasting, "--force"}, scratch_.path());
        while (!fs::exists(scratch_ / "cut" / after)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        program.send(SIGINT);
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("polargrain resume cut"));
        ASSERT_EQ(polargrain({"resume", "cut"}).exit_code, 0);
        expect_equal_files(scratch_ / "cut", whole);
        fs::remove_all(scratch_ / "cut");
    }
}

TEST_F(Resume, UntilCarriesAFinishedRunOn) {
    scratch_.write("everything.toml", k_everything);
    ASSERT_EQ(polargrain({"run", "everything.toml", "-o", "whole"}).exit_code, 0);
    // Neither a multiple of an output interval nor of the time step.
    ASSERT_EQ(polargrain({"run", "everything.toml", "-o", "short", "--set", "run.duration=0.00734"}).exit_code, 0);
    const Outcome resumed = polargrain({"resume", "short", "--until", "0.012"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    expect_equal_files(scratch_ / "short", folder("whole"));
    for (const char* until : {"nan", "inf", "0"}) {
        EXPECT_THAT(polargrain({"resume", "short", "--until", until}).err, HasSubstr("is no time to run to"));
    }
    const Outcome back = polargrain({"resume", "short", "--until", "0.008"});
    EXPECT_EQ(back.exit_code, 2);
    EXPECT_THAT(back.err, HasSubstr("at t = 0.012"));
    ASSERT_EQ(polargrain({"resume", "short"}).exit_code, 0) << "nothing to do is no mistake";
    expect_equal_files(scratch_ / "short", folder("whole"));
}

TEST_F(Resume, AFullDiskEndsTheRunWithAnErrorAndResumingWithRoomMendsIt) {
    scratch_.write("everything.toml", k_everything);
    const Reference whole(scratch_.path(), "contact");
    for (const rlim_t room : {8'000UL, 20'000UL, 32'000UL}) {
        const Outcome full =
            RunningProgram({"run", "everything.toml", "-o", "cut", "--force"}, scratch_.path(), room).wait();
        EXPECT_EQ(full.exit_code, 1) << full.err;
        EXPECT_THAT(full.err, HasSubstr("File too large")) << "the system's reason";
        EXPECT_THAT(full.err, HasSubstr("cut/")) << "which file";
        EXPECT_THAT(full.err, HasSubstr("polargrain resume cut"));
        const Outcome resumed = polargrain({"resume", "cut"});
        ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
        expect_equal_files(scratch_ / "cut", whole.files);
    }
}

TEST_F(Resume, RefusesWhatIsNoRunFolderOrHasADamagedCheckpoint) {
    EXPECT_EQ(polargrain({"resume", "nowhere"}).exit_code, 2);
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(polargrain({"run", "three.toml", "-o", "run"}).exit_code, 0);
    const std::string good = read_file(scratch_ / "run" / "checkpoint.h5");
    const auto before = folder("run");
    const struct {
        std::string content;
        const char* says;
    } cases[] = {{good.substr(0, good.size() / 2), "damaged or cut short"},
                 {good + "x", "damaged or cut short"},
                 {"something else", "not a checkpoint that polargrain wrote"},
                 {replaced(good, "format 4\n", "format 9\n"), "a newer polargrain"},
                 {replaced(good, "format 4\n", "format 1\n"), "the older polargrain"}};
    for (const auto& [content, says] : cases) {
        scratch_.write("run/checkpoint.h5", content);
        const Outcome refused = polargrain({"resume", "run"});
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr(says));
        EXPECT_THAT(refused.err, HasSubstr("run/checkpoint.h5"));
        EXPECT_EQ(folder("run"), before) << "refusing changes nothing";
    }
}

TEST_F(Resume, RefusesAScenarioOrFilesThatWereChangedMeanwhile) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(polargrain({"run", "three.toml", "-o", "run"}).exit_code, 0);
    const std::string scenario = read_file(scratch_ / "run" / "scenario.toml");
    scratch_.write("run/scenario.toml", replaced(scenario, "friction = 0.3", "friction = 0.4"));
    const Outcome refused = polargrain({"resume", "run"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("scenario.toml"));
    scratch_.write("run/scenario.toml", replaced(scenario, "duration = 0.05", "duration = 0.02"));
    const Outcome earlier = polargrain({"resume", "run"});
    EXPECT_EQ(earlier.exit_code, 2);
    EXPECT_THAT(earlier.err, testing::AllOf(HasSubstr("run.duration is 0.02 s"), HasSubstr("at t = 0.05 s already")));
    scratch_.write("run/scenario.toml", scenario);
    scratch_.write("run/series.csv", "time\n");
    const Outcome shorter = polargrain({"resume", "run"});
    EXPECT_EQ(shorter.exit_code, 2);
    EXPECT_THAT(shorter.err, HasSubstr("series.csv"));
}

TEST_F(Resume, ThatIsRefusedChangesNothing) {
    scratch_.write("everything.toml", k_everything);
    // The last row and frame stand behind the checkpoint: they must not be cut off either.
    ASSERT_EQ(polargrain({"run", "everything.toml", "-o", "run", "--set", "run.duration=0.00734"}).exit_code, 0);
    const auto whole = folder("run");
    const auto refused_with = [&](const std::string& name, const std::string& content) {
        scratch_.write("run/" + name, content);
        const auto before = folder("run");
        const Outcome refused = polargrain({"resume", "run", "--until", "0.012"});
        EXPECT_EQ(refused.exit_code, 2) << name << ": " << refused.out << refused.err;
        EXPECT_THAT(refused.err, HasSubstr(name));
        EXPECT_THAT(refused.out, testing::Not(HasSubstr("carried on")));
        EXPECT_TRUE(folder("run") == before) << name;
        scratch_.write("run/" + name, whole.at(name));
    };
    for (const char* name : {"series.csv", "impacts.csv", "frames/index.csv"}) {
        refused_with(name, "x\n");
        refused_with(name, "x" + whole.at(name).substr(1));
        std::string with_returns = whole.at(name);
        for (std::size_t at = 0; (at = with_returns.find('\n', at)) != std::string::npos; at += 2) {
            with_returns.insert(at, "\r");
        }
        refused_with(name, with_returns);
    }
    const std::string& trajectory = whole.at("trajectory.h5");
    refused_with("trajectory.h5", trajectory.substr(0, trajectory.size() / 2));
    const Outcome resumed = polargrain({"resume", "run", "--until", "0.012"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

TEST_F(Resume, DoesNotBeginAFinishedRunAnewWhereItsCheckpointIsGone) {
    scratch_.write("three.toml", k_three_disks);
    ASSERT_EQ(polargrain({"run", "three.toml", "-o", "run"}).exit_code, 0);
    fs::remove(scratch_ / "run" / "checkpoint.h5");
    const auto before = folder("run");
    const Outcome refused = polargrain({"resume", "run", "--until", "0.1"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("run/checkpoint.h5"));
    EXPECT_THAT(refused.err, HasSubstr("polargrain run run/scenario.toml -o run --force"));
    EXPECT_TRUE(folder("run") == before);
    EXPECT_EQ(polargrain({"run", "run/scenario.toml", "-o", "run", "--force"}).exit_code, 0) << "as it says";
    expect_equal_files(scratch_ / "run", before);
}

TEST_F(Resume, WithOtherThreadsChangesNoByte) {
    scratch_.write("everything.toml", k_everything);
    for (const std::string& engine : engines()) {
        for (const char* name : {"one", "three"}) {
            ASSERT_EQ(polargrain({"run", "everything.toml", "-o", name, "--engine", engine, "--set",
                                  "run.duration=0.006", "--force"})
                          .exit_code,
                      0);
        }
        ASSERT_EQ(polargrain({"resume", "one", "--until", "0.012"}).exit_code, 0);
        const Outcome resumed = polargrain({"resume", "three", "--until", "0.012", "--threads", "3"});
        ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
        auto expected = folder("one");
        nlohmann::json summary = nlohmann::json::parse(expected.at("summary.json"));
        summary["threads"] = 3;
        expected["summary.json"] = summary.dump();
        expect_equal_files(scratch_ / "three", expected);
    }
    EXPECT_EQ(polargrain({"resume", "one", "--threads", "0"}).exit_code, 2);
}

TEST_F(Resume, LeavesARunInProgressAlone) {
    scratch_.write("long.toml", replaced(k_three_disks, "duration = 0.05", "duration = 1e6"));
    RunningProgram program({"run", "long.toml", "-o", "long"}, scratch_.path());
    const auto give_up = steady_clock::now() + std::chrono::seconds(60);
    while (!fs::exists(scratch_ / "long" / "checkpoint.h5") && steady_clock::now() < give_up) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Outcome refused = polargrain({"resume", "long"});
    program.send(SIGKILL);
    program.wait();
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("another polargrain is running"));
}

}  // namespace
}  // namespace polargrain
