#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/core/elementary.h"
#include "tests/scenarios/scenario_text.h"

namespace polargrain::testing {
namespace {

using ::testing::ElementsAre;

TEST(Values, AnInclineTurnsGravityAboutTheOrigin) {
    // Equations 47-48: g (sin beta, -cos beta), beta in degrees in the file.
    const Scenario scenario = load_text(replaced(small_scenario(), "duration = 2.0", "gravity = 10.0\nincline = 30.0"));
    EXPECT_NEAR(scenario.scene.gravity.x(), 5.0, 1e-14);
    EXPECT_NEAR(scenario.scene.gravity.y(), -10.0 * std::sqrt(0.75), 1e-14);
}

TEST(Values, AnglesAreDegreesInTheFileAndRadiansInside) {
    const Scenario scenario = load_text(small_scenario() + "angle = 90.0\nvelocity = [1, 2]\nspin = -3\n");
    EXPECT_DOUBLE_EQ(scenario.scene.grains.angle[0], k_pi / 2);
    EXPECT_EQ(scenario.scene.grains.velocity(0), Vec2(1.0, 2.0));
    EXPECT_EQ(scenario.scene.grains.spin[0], -3.0);
}

TEST(Values, DefaultsAreThoseOfTheManual) {
    const Scenario scenario = load_text(replaced(small_scenario(), "duration = 2.0\n", ""));
    EXPECT_EQ(scenario.run.duration, 1.0);
    EXPECT_EQ(scenario.run.engine, k_default_engine);
    EXPECT_FALSE(scenario.run.time_step.has_value());
    EXPECT_EQ(scenario.run.time_step_factor, 1.0);
    EXPECT_EQ(scenario.scene.gravity, Vec2(0.0, -9.81));
    EXPECT_EQ(scenario.scene.seed, 1U);
    EXPECT_EQ(scenario.scene.threads, 1);
    EXPECT_FALSE(scenario.settle.has_value());
    EXPECT_EQ(scenario.output.frames.every, 0.01);
    EXPECT_EQ(scenario.output.frames.width, 1280);
    EXPECT_EQ(scenario.output.series_every, 0.002);
    EXPECT_EQ(scenario.output.trajectory_every, 0.002);
    EXPECT_FALSE(scenario.output.impacts);
}

TEST(Values, EveryOutputKeyArrives) {
    const Scenario scenario = load_text(small_scenario() + R"(
[output]
frames = { every = 0, format = "svg", width = 640, height = 480, colour = "spin", contacts = true, view = [[-1, -2], [3, 4]], colour_max = 2.5, follow = "floor" }
trajectory = { every = 0.5 }
series = { every = 0.25 }
impacts = true
checkpoint = { every_wall = 7 }
[settle]
until_energy = 1e-3
at_most = 2
[[expect]]
quantity = "area_fraction"
min = 0.8
max = 0.9
unit = "1"
source = "here"
)");
    const FrameSettings& frames = scenario.output.frames;
    EXPECT_EQ(frames.every, 0.0);
    EXPECT_EQ(frames.format, "svg");
    EXPECT_EQ(frames.width, 640);
    EXPECT_EQ(frames.height, 480);
    EXPECT_EQ(frames.colour, "spin");
    EXPECT_TRUE(frames.contacts);
    EXPECT_EQ(frames.view, (std::pair{Vec2(-1, -2), Vec2(3, 4)}));
    EXPECT_EQ(frames.colour_max, 2.5);
    EXPECT_EQ(frames.follow, "floor");
    EXPECT_EQ(scenario.output.trajectory_every, 0.5);
    EXPECT_EQ(scenario.output.series_every, 0.25);
    EXPECT_TRUE(scenario.output.impacts);
    EXPECT_EQ(scenario.output.checkpoint_every_wall, 7.0);
    ASSERT_TRUE(scenario.settle.has_value());
    EXPECT_EQ(scenario.settle->until_energy, 1e-3);
    EXPECT_EQ(scenario.settle->at_most, 2.0);
    ASSERT_EQ(scenario.expectations.size(), 1U);
    EXPECT_EQ(scenario.expectations[0].min, 0.8);
    EXPECT_EQ(scenario.expectations[0].max, 0.9);
    EXPECT_EQ(scenario.expectations[0].unit, "1");
    EXPECT_EQ(scenario.expectations[0].source, "here");
}

TEST(Values, PairsOverrideTheMaterials) {
    const std::string steel = "[materials.steel]\nrestitution = { mean = 0.6, stddev = 0.1 }\nfriction = 0.2\n";
    const std::string pair = "[[pairs]]\nbetween = [\"steel\", \"rubber\"]\nfriction = 0.9\nrestitution = 0.1\n";
    const Scenario plain = load_text(small_scenario() + steel);
    const Materials& materials = plain.scene.materials;
    const MaterialIndex rubber = materials.find("rubber").value();
    const MaterialIndex other = materials.find("steel").value();
    EXPECT_EQ(materials[other].restitution.stddev, 0.1);
    EXPECT_DOUBLE_EQ(materials.pair(rubber, other).friction, std::sqrt(0.5 * 0.2));
    EXPECT_FALSE(materials.pair(rubber, other).restitution.has_value());

    const Scenario overridden = load_text(small_scenario() + steel + pair);
    for (const auto& [a, b] : {std::pair{rubber, other}, std::pair{other, rubber}}) {
        EXPECT_EQ(overridden.scene.materials.pair(a, b).friction, 0.9);
        EXPECT_EQ(overridden.scene.materials.pair(a, b).restitution.value().mean, 0.1);
    }
}

TEST(Values, WallsMoveAndGo) {
    const Scenario scenario = load_text(small_scenario() + R"(
[[walls]]
name = "shaker"
material = "rubber"
points = [[0, -1], [1, -1]]
motion = { type = "sine", direction = [3, 4], amplitude = 0.5, frequency = 2.0, start = 0.25 }
remove_at = 1.5
[[walls]]
name = "drum"
material = "rubber"
points = [[0, -3], [1, -3]]
motion = { type = "rotate", centre = [1, 2], rate = -6.0, start = 0.5 }
[[walls]]
name = "gate"
material = "rubber"
points = [[0, -5], [1, -5]]
motion = { type = "linear", velocity = [0.25, -3], start = 0.5, end = 0.75 }
[[walls]]
name = "belt"
material = "rubber"
points = [[0, -7], [1, -7]]
motion = { type = "linear", velocity = [0, 1] }
)");
    const auto& sine = std::get<SineMotion>(scenario.scene.walls[1].motion);
    EXPECT_NEAR((sine.direction - Vec2(0.6, 0.8)).norm(), 0.0, 1e-15);
    EXPECT_EQ(sine.amplitude, 0.5);
    EXPECT_EQ(sine.frequency, 2.0);
    EXPECT_EQ(sine.start, 0.25);
    EXPECT_EQ(scenario.scene.walls[1].remove_at, 1.5);
    const auto& turn = std::get<RotationMotion>(scenario.scene.walls[2].motion);
    EXPECT_EQ(turn.centre, Vec2(1, 2));
    EXPECT_EQ(turn.rate, -6.0);
    EXPECT_EQ(turn.start, 0.5);
    EXPECT_FALSE(scenario.scene.walls[2].remove_at.has_value());
    const auto& linear = std::get<LinearMotion>(scenario.scene.walls[3].motion);
    EXPECT_EQ(linear.velocity, Vec2(0.25, -3));
    EXPECT_EQ(linear.start, 0.5);
    EXPECT_EQ(linear.end, 0.75);
    const auto& endless = std::get<LinearMotion>(scenario.scene.walls[4].motion);
    EXPECT_EQ(endless.start, 0.0);
    EXPECT_FALSE(endless.end.has_value());
    const Scenario again = load_text(scenario.resolved_toml);
    EXPECT_EQ(again.resolved_toml, scenario.resolved_toml);
    EXPECT_EQ(std::get<LinearMotion>(again.scene.walls[3].motion).end, 0.75);
    EXPECT_FALSE(std::get<LinearMotion>(again.scene.walls[4].motion).end.has_value());
}

TEST(Values, TheFirstOfARowMayDifferInEveryKey) {
    const Scenario scenario = load_text(replaced(small_scenario(), "[[grains]]", R"([materials.cork]
density = 200.0
restitution = 0.5
friction = 0.5
[[rows]]
shape = "ball"
material = "rubber"
count = 3
start = [-0.5, 2.0]
step = [0.3, 0.1]
angle = 10.0
velocity = [0.0, -1.0]
spin = 1.0
first = { shape = "bar", material = "cork", position = [-0.9, 2.5], angle = 45.0, velocity = [4.0, 0.0], spin = 2.0 }
[[grains]])"));
    const Grains& grains = scenario.scene.grains;
    ASSERT_EQ(grains.size(), 4);
    EXPECT_EQ(name(scenario.scene.shape_of(0)), "bar");
    EXPECT_EQ(name(scenario.scene.shape_of(1)), "ball");
    EXPECT_EQ(scenario.scene.materials[grains.material[0]].name, "cork");
    EXPECT_EQ(scenario.scene.materials[grains.material[2]].name, "rubber");
    EXPECT_EQ(grains.position(0), Vec2(-0.9, 2.5));
    EXPECT_EQ(grains.position(1), Vec2(-0.5, 2.0) + Vec2(0.3, 0.1));
    EXPECT_EQ(grains.position(2), Vec2(-0.5, 2.0) + 2.0 * Vec2(0.3, 0.1));
    EXPECT_DOUBLE_EQ(grains.angle[0], k_pi / 4);
    EXPECT_EQ(grains.velocity(0), Vec2(4.0, 0.0));
    EXPECT_EQ(grains.velocity(1), Vec2(0.0, -1.0));
    EXPECT_THAT(grains.spin, ElementsAre(2.0, 1.0, 1.0, 0.0));
}

TEST(Values, IdsFollowTheOrderOfTheFileAcrossKindsOfTables) {
    const std::string fill =
        "[[fill]]\ncount = 5\nshapes = [\"ball\"]\nmaterial = \"rubber\"\nregion = [[-1, 2], [1, 3]]\n";
    const std::string row =
        "[[rows]]\nshape = \"bar\"\nmaterial = \"rubber\"\ncount = 2\nstart = [0, 4]\nstep = [1, 0]\n";
    const Scenario scenario = load_text(small_scenario() + fill + row);
    const Scene& scene = scenario.scene;
    ASSERT_EQ(scene.grains.size(), 8);
    EXPECT_EQ(scene.grains.position(0), Vec2(0, 1));
    for (GrainIndex k = 1; k < 6; ++k) EXPECT_EQ(name(scene.shape_of(k)), "ball") << k;
    EXPECT_EQ(scene.grains.position(6), Vec2(0, 4));
    EXPECT_EQ(name(scene.shape_of(7)), "bar");

    const Scenario again = load_text(scenario.resolved_toml);
    EXPECT_EQ(state_hash(initial_world(again.scene)), state_hash(initial_world(scene)));
}

TEST(Values, ShapesAreSharedUnlessEachGrainHasItsOwn) {
    const std::string row =
        "[[rows]]\nshape = \"stone\"\nmaterial = \"rubber\"\ncount = 4\nstart = [0, 4]\nstep = [1, 0]\n";
    const std::string stone = "[shapes.stone]\ntype = \"rough\"\nradius = 0.1\nroughness = 0.2\n";
    const Scenario own = load_text(small_scenario() + stone + row);
    EXPECT_EQ(own.scene.shapes.size(), 5U);
    EXPECT_NE(area(own.scene.shape_of(1)), area(own.scene.shape_of(2)));
    EXPECT_NE(name(own.scene.shape_of(1)), name(own.scene.shape_of(2)));
    const Scenario same = load_text(small_scenario() + stone + "same = true\n" + row);
    EXPECT_EQ(same.scene.shapes.size(), 2U);
    EXPECT_EQ(same.scene.grains.shape[1], same.scene.grains.shape[4]);
}

TEST(Values, EveryShapeTypeMakesItsArea) {
    const auto area_of = [](const std::string& keys) {
        return area(load_text(replaced(small_scenario(), "type = \"disk\"\nradius = 0.05", keys)).scene.shape_of(0));
    };
    EXPECT_DOUBLE_EQ(area_of("type = \"disk\"\nradius = 0.1"), k_pi * 0.01);
    EXPECT_NEAR(area_of("type = \"rectangle\"\nwidth = 0.1\nheight = 0.2\nvertices = 12"), 0.02, 1e-15);
    EXPECT_NEAR(area_of("type = \"regular\"\nradius = 0.1\nsides = 4"), 0.02, 1e-15);
    EXPECT_NEAR(area_of("type = \"ellipse\"\nwidth = 0.2\nheight = 0.1\nvertices = 400"), k_pi * 0.005, 1e-5);
    EXPECT_NEAR(area_of("type = \"superellipse\"\nwidth = 0.2\nheight = 0.1\nexponent = 1\nvertices = 400"), 0.01,
                1e-5);
    EXPECT_NEAR(area_of("type = \"stick\"\nlength = 0.3\nwidth = 0.1\nvertices = 400"), 0.02 + k_pi * 0.0025, 1e-6);
    EXPECT_NEAR(area_of("type = \"star\"\nradius = 0.1\ninner_radius = 0.05\npoints = 6"), 6 * 0.1 * 0.05 * 0.5, 1e-15);
    EXPECT_NEAR(area_of("type = \"polar\"\nradii = [0.1, 0.1, 0.1, 0.1]"), 0.02, 1e-15);
    EXPECT_NEAR(area_of("type = \"polar\"\nvertices = [[0.1, 0], [0.1, 90], [0.1, 180], [0.1, 270]]"), 0.02, 1e-15);
    EXPECT_NEAR(area_of("type = \"outline\"\npoints = [[0, 0], [0.1, 0], [0, 0.1]]"), 0.005, 1e-15);
    const double gravel = area_of("type = \"file\"\npath = \"gravel\"");
    EXPECT_NEAR(area_of("type = \"file\"\npath = \"gravel\"\nscale = 2.0"), 4.0 * gravel, 1e-9 * gravel);
    EXPECT_NEAR(gravel, 0.02 * 0.02, 2e-4) << "a crushed stone of 20 mm";
}

}  // namespace
}  // namespace polargrain::testing
