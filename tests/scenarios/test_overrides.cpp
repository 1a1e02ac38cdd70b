#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_text.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Scenario load_with(const std::vector<std::string>& set) { return load_text(small_scenario(), {.set = set}); }
std::string complaint_with(const std::string& set) { return complaint(small_scenario(), {.set = {set}}); }

TEST(Overrides, ReachEveryPlaceOfTheFile) {
    EXPECT_EQ(load_with({"run.duration=3"}).run.duration, 3.0);
    EXPECT_EQ(load_with({"run.duration = 3.5"}).run.duration, 3.5);
    EXPECT_EQ(load_with({"walls[0].points=[[-2,-1],[2,-1]]"}).scene.walls[0].points[1], Vec2(2, -1));
    EXPECT_EQ(load_with({"walls.0.points[1]=[3,0]"}).scene.walls[0].points[1], Vec2(3, 0));
    EXPECT_EQ(load_with({"grains[0].position[1]=0.5"}).scene.grains.position(0), Vec2(0.0, 0.5));
    EXPECT_EQ(load_with({"materials.rubber.restitution={mean=0.5,stddev=0.1}"}).scene.materials[0].restitution.stddev,
              0.1);
}

TEST(Overrides, MakeTablesThatAreNotThere) {
    EXPECT_EQ(load_with({"output.frames.every=0.5"}).output.frames.every, 0.5);
    EXPECT_EQ(load_with({"settle.at_most=2"}).settle->at_most, 2.0);
}

TEST(Overrides, TakeAWordWithoutQuotesAsAString) {
    EXPECT_EQ(load_with({"run.engine=dem"}).run.engine, "dem");
    EXPECT_EQ(load_with({"title=Two words"}).title, "Two words");
    EXPECT_EQ(load_with({"run.engine=\"box2d\""}).run.engine, "box2d");
}

TEST(Overrides, HoldInTheOrderGiven) { EXPECT_EQ(load_with({"run.duration=3", "run.duration=4"}).run.duration, 4.0); }

TEST(Overrides, OptionsAreShortForThem) {
    const Scenario scenario =
        load_text(small_scenario(), {.set = {}, .engine = "contact", .seed = 9, .threads = 3, .no_frames = true});
    EXPECT_EQ(scenario.run.engine, "contact");
    EXPECT_EQ(scenario.scene.seed, 9U);
    EXPECT_EQ(scenario.scene.threads, 3);
    EXPECT_EQ(scenario.output.frames.every, 0.0);
    EXPECT_THAT(scenario.resolved_toml, HasSubstr("seed = 9\n"));
}

TEST(Overrides, AreNamedWhereTheyAreWrong) {
    EXPECT_THAT(complaint_with("run.duraton=2"),
                StartsWith("--set run.duraton=2: unknown key run.duraton; did you mean "
                           "\"duration\"?"));
    EXPECT_THAT(complaint_with("rnu.duration=2"),
                StartsWith("--set rnu.duration=2: unknown key rnu; did you mean \"run\"?"));
    EXPECT_THAT(complaint_with("run.duration=-2"), StartsWith("--set run.duration=-2: run.duration: is -2"));
    EXPECT_THAT(complaint_with("walls[0].points=[[0,0],[1,nan]]"),
                StartsWith("--set walls[0].points=[[0,0],[1,nan]]: walls[0].points[1][1]: is nan"));
    EXPECT_THAT(complaint(small_scenario(), {.set = {}, .engine = "dme"}),
                AllOf(StartsWith("--engine dme: run.engine"), HasSubstr("did you mean \"dem\"?")));
}

TEST(Overrides, MustFitTheFile) {
    EXPECT_THAT(complaint_with("run.duration"), HasSubstr("has no \"=\""));
    EXPECT_THAT(complaint_with("walls[1].name=x"), HasSubstr("there is no walls[1]"));
    EXPECT_THAT(complaint_with("walls.name=x"), HasSubstr("walls is an array"));
    EXPECT_THAT(complaint_with("walls[x].name=x"), HasSubstr("\"x\" is no index"));
    EXPECT_THAT(complaint_with("walls[0=x"), HasSubstr("closing bracket"));
    EXPECT_THAT(complaint_with("run..duration=2"), HasSubstr("empty name"));
    EXPECT_THAT(complaint_with("run.duration.long=2"), HasSubstr("run.duration is a value"));
    EXPECT_THAT(complaint_with("run.duration=[1,"), HasSubstr("no TOML"));
}

}  // namespace
}  // namespace polargrain::testing
