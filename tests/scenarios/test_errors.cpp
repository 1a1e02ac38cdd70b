#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/scenarios/scenario_text.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// One mistake made in the small scenario, and what the message must say.
struct Mistake {
    const char* name;
    const char* from;
    const char* to;
    const char* where;                   ///< how the message begins
    std::vector<const char*> fragments;  ///< what else it holds: the key and the remedy
};

class Mistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreToldWithLineColumnKeyAndRemedy) {
    const Mistake& mistake = GetParam();
    const std::string message = complaint(replaced(small_scenario(), mistake.from, mistake.to));
    EXPECT_THAT(message, StartsWith(mistake.where));
    for (const char* fragment : mistake.fragments) EXPECT_THAT(message, HasSubstr(fragment));
}

const Mistake k_mistakes[] = {
    {"NoToml", "duration = 2.0", "duration = ", "case.toml:3:12: ", {"not valid TOML"}},
    {"UnknownKey", "duration", "duraton", "case.toml:3:1: ", {"unknown key run.duraton", "did you mean \"duration\"?"}},
    {"UnknownTable", "[run]", "[rum]", "case.toml:2:2: ", {"unknown key rum", "did you mean \"run\"?"}},
    {"UnknownKeyOfType",
     "radius = 0.05",
     "radios = 0.05",
     "case.toml:10:1: ",
     {"shapes.ball.radios (of type disk)", "did you mean \"radius\"?"}},
    {"UnknownKeyFarFromAll", "duration", "zzzzzzzzzzzz", "case.toml:3:1: ", {"it takes engine, duration, time_step"}},
    {"WrongType", "2.0", "\"long\"", "case.toml:3:12: ", {"run.duration", "is a string, must be a number", "write"}},
    {"NotFinite", "2.0", "inf", "case.toml:3:12: ", {"run.duration", "is inf", "positive"}},
    {"NotANumber", "0.05", "nan", "case.toml:10:10: ", {"shapes.ball.radius", "is nan"}},
    {"Negative", "2.0", "-2.0", "case.toml:3:12: ", {"run.duration", "is -2", "positive"}},
    {"RestitutionAboveOne", "0.8", "1.2", "case.toml:6:15: ", {"materials.rubber.restitution", "between 0 and 1"}},
    {"NegativeSpread",
     "0.8",
     "{ mean = 0.8, stddev = -0.1 }",
     "case.toml:6:38: ",
     {"materials.rubber.restitution.stddev", "is -0.1"}},
    {"RestitutionWithoutMean",
     "0.8",
     "{ stddev = 0.1 }",
     "case.toml:6:15: ",
     {"materials.rubber.restitution.mean is missing"}},
    {"NegativeFriction", "0.5", "-0.5", "case.toml:7:12: ", {"materials.rubber.friction", "zero or positive"}},
    {"MissingKey", "friction = 0.5\n", "", "case.toml:4:1: ", {"materials.rubber.friction is missing", "add friction"}},
    {"MassZero", "1100.0", "0.0", "case.toml:5:11: ", {"materials.rubber.density", "positive"}},
    {"GrainsWithoutDensity",
     "density = 1100.0\n",
     "",
     "case.toml:20:12: ",
     {"grains[0].material", "no mass", "add density", "[materials.rubber]"}},
    {"UnknownMaterial",
     "material = \"rubber\"\nposition",
     "material = \"ruber\"\nposition",
     "case.toml:21:12: ",
     {"grains[0].material", "no material \"ruber\"", "did you mean \"rubber\"?"}},
    {"UnknownShape", "shape = \"ball\"", "shape = \"bell\"", "case.toml:20:9: ", {"no shape \"bell\"", "\"ball\"?"}},
    {"UnknownShapeType", "\"disk\"", "\"disc\"", "case.toml:9:8: ", {"shapes.ball.type", "did you mean \"disk\"?"}},
    {"NoShapeType", "type = \"disk\"\n", "", "case.toml:8:1: ", {"shapes.ball.type is missing", "rectangle, disk"}},
    {"UnknownEngine",
     "duration",
     "engine = \"contact-1995\"\nduration",
     "case.toml:3:10: ",
     {"run.engine", "did you mean \"contact-1994\"?", "contact, contact-1994, box2d, dem"}},
    {"TimeStepWord", "duration", "time_step = \"small\"\nduration", "case.toml:3:13: ", {"run.time_step", "critical"}},
    {"SeedWithFraction", "duration", "seed = 1.5\nduration", "case.toml:3:8: ", {"run.seed", "whole number"}},
    {"SeedNegative", "duration", "seed = -1\nduration", "case.toml:3:8: ", {"run.seed", "is -1"}},
    {"RunIsNoTable", "[run]\nduration = 2.0", "run = 2", "case.toml:2:7: ", {"run: is a number, must be a table"}},
    {"WallsAreNoArray", "[[walls]]", "[walls]", "case.toml:15:1: ", {"walls: is a table", "[[walls]]"}},
    {"WallOfOnePoint", ", [1.0, 0.0]]", "]", "case.toml:18:10: ", {"walls[0].points", "needs 2 at least"}},
    {"PointOfThree", "[1.0, 0.0]", "[1.0, 0.0, 0.0]", "case.toml:18:24: ", {"walls[0].points[1]", "pair of numbers"}},
    {"WallPointTwice", "[1.0, 0.0]", "[-1.0, 0.0]", "case.toml:18:10: ", {"points 0 and 1", "coincide"}},
    {"WallNameTwice",
     "[[grains]]",
     "[[walls]]\nname = \"floor\"\nmaterial = \"rubber\"\npoints = [[0, -1], [1, -1]]\n[[grains]]",
     "case.toml:20:8: ",
     {"walls[1].name", "\"floor\" already"}},
    {"WallNameWithSpace", "\"floor\"", "\"the floor\"", "case.toml:16:8: ", {"walls[0].name", "rename"}},
    {"MotionType",
     "[[grains]]",
     "motion = { type = \"sinus\" }\n[[grains]]",
     "case.toml:19:19: ",
     {"walls[0].motion.type", "did you mean \"sine\"?"}},
    {"MotionWithoutDirection",
     "[[grains]]",
     "motion = { type = \"sine\", direction = [0, 0], amplitude = 1.0, frequency = 1.0 }\n[[grains]]",
     "case.toml:19:39: ",
     {"walls[0].motion.direction", "no length"}},
    {"MotionWithoutVelocity",
     "[[grains]]",
     "motion = { type = \"linear\", start = 1.0 }\n[[grains]]",
     "case.toml:19:10: ",
     {"walls[0].motion.velocity", "missing"}},
    {"MotionThatRests",
     "[[grains]]",
     "motion = { type = \"linear\", velocity = [0, 0.0] }\n[[grains]]",
     "case.toml:19:40: ",
     {"walls[0].motion.velocity", "is zero; give for example [0.1, 0]"}},
    {"MotionThatStartsBeforeTheBeginning",
     "[[grains]]",
     "motion = { type = \"linear\", velocity = [0, 1], start = -1.0 }\n[[grains]]",
     "case.toml:19:56: ",
     {"walls[0].motion.start", "zero or positive"}},
    {"MotionThatEndsBeforeItStarts",
     "[[grains]]",
     "motion = { type = \"linear\", velocity = [0, 1], start = 2.0, end = 2.0 }\n[[grains]]",
     "case.toml:19:67: ",
     {"walls[0].motion.end", "2 s is not after the start at 2 s"}},
    {"MotionWithAWrongKey",
     "[[grains]]",
     "motion = { type = \"linear\", velocity = [0, 1], stop = 2.0 }\n[[grains]]",
     "case.toml:19:",
     {"walls[0].motion.stop"}},
    {"PairOfOne",
     "[[walls]]",
     "[[pairs]]\nbetween = [\"rubber\"]\nfriction = 0.1\n[[walls]]",
     "case.toml:16:11: ",
     {"pairs[0].between", "must name two"}},
    {"PairThatSaysNothing",
     "[[walls]]",
     "[[pairs]]\nbetween = [\"rubber\", \"rubber\"]\n[[walls]]",
     "case.toml:15:1: ",
     {"pairs[0]", "give friction, restitution or both"}},
    {"FrameFormat",
     "[[walls]]",
     "[output]\nframes = { format = \"gif\" }\n[[walls]]",
     "case.toml:16:21: ",
     {"output.frames.format", "png, svg, pdf"}},
    {"FrameColour",
     "[[walls]]",
     "[output]\nframes = { colour = \"sped\" }\n[[walls]]",
     "case.toml:16:21: ",
     {"output.frames.colour", "did you mean \"speed\"?"}},
    {"ViewUpsideDown",
     "[[walls]]",
     "[output]\nframes = { view = [[0, 0], [1, -1]] }\n[[walls]]",
     "case.toml:16:19: ",
     {"output.frames.view", "upper right corner"}},
    {"FollowedWallUnknown",
     "[[walls]]",
     "[output]\nframes = { follow = \"flor\" }\n[[walls]]",
     "case.toml:16:21: ",
     {"output.frames.follow", "did you mean \"floor\"?"}},
    {"QuantityMisspelt",
     "[[walls]]",
     "[[expect]]\nquantity = \"area_fracton\"\nmin = 0.8\n[[walls]]",
     "case.toml:16:12: ",
     {"expect[0].quantity", "did you mean \"area_fraction\"?"}},
    {"ExpectationWithoutBand",
     "[[walls]]",
     "[[expect]]\nquantity = \"area_fraction\"\n[[walls]]",
     "case.toml:15:1: ",
     {"expect[0]", "neither min nor max"}},
    {"SettleWithoutGravity",
     "duration = 2.0",
     "gravity = 0.0\n[settle]\nat_most = 1.0",
     "case.toml:4:1: ",
     {"settle", "gravity"}},
    {"OutlineCrossesItself",
     "type = \"rectangle\"\nwidth = 0.2\nheight = 0.1",
     "type = \"outline\"\npoints = [[0, 0], [1, 1], [1, 0], [0, 1]]",
     "case.toml:11:1: ",
     {"shape \"bar\"", "cross"}},
    {"OutlineNotStarShaped",
     "type = \"rectangle\"\nwidth = 0.2\nheight = 0.1",
     "type = \"outline\"\npoints = [[0, 0], [3, 0], [3, 3], [2, 3], [2, 0.2], [1, 0.2], [1, 3], [0, 3]]",
     "case.toml:11:1: ",
     {"shape \"bar\"", "star-shaped", "vertex"}},
    {"OutlineFileMisspelt",
     "type = \"disk\"\nradius = 0.05",
     "type = \"file\"\npath = \"gravl\"",
     "case.toml:10:8: ",
     {"shapes.ball.path", "\"gravel\""}},
    {"GrainInWall",
     "position = [0.0, 1.0]",
     "position = [0.0, 0.04]",
     "case.toml:19:1: ",
     {"grain 0 (grains[0], line 19)", "wall \"floor\"", "piece 0 from (-1, 0) to (1, 0)", "move"}},
    {"GrainInGrain",
     "[[grains]]",
     "[[rows]]\nshape = \"bar\"\nmaterial = \"rubber\"\ncount = 3\nstart = [-0.25, 1.0]\nstep = [0.25, "
     "0.0]\n[[grains]]",
     "case.toml:25:1: ",
     {"grain 3 (grains[0], line 25)", "overlaps grain 1 (rows[0] number 1, line 19)"}},
};

std::string mistake_name(const ::testing::TestParamInfo<Mistake>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Reader, Mistakes, ::testing::ValuesIn(k_mistakes), mistake_name);

TEST(Reader, TakesTheSmallScenario) { EXPECT_EQ(complaint(small_scenario()), ""); }

TEST(Reader, TellsThatThereIsNoFile) {
    try {
        load_scenario("nowhere/no.toml");
        FAIL() << "a file that is not there was read";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("nowhere/no.toml: there is no such file"));
    }
}

TEST(Reader, CountsAWallThatIsRemovedAtOnceOnlyWhereGrainsSettleFirst) {
    const std::string in_wall =
        replaced(replaced(small_scenario(), "[0.0, 1.0]", "[0.0, 0.04]"), "[[grains]]", "remove_at = 0.0\n[[grains]]");
    EXPECT_EQ(complaint(in_wall), "");
    EXPECT_THAT(complaint(in_wall + "[settle]\n"), HasSubstr("wall \"floor\""));
}

TEST(Reader, LetsGrainsTouch) {
    EXPECT_EQ(complaint(replaced(small_scenario(), "[0.0, 1.0]", "[0.0, 0.05]")), "");
    EXPECT_THAT(complaint(replaced(small_scenario(), "[0.0, 1.0]", "[0.0, 0.0499999]")), HasSubstr("overlaps"));
}

}  // namespace
}  // namespace polargrain::testing
