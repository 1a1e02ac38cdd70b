#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "tests/scenarios/scenario_text.h"
#include "tests/support/scenes.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
    std::vector<std::uint64_t> all(values.size());
    std::transform(values.begin(), values.end(), all.begin(), [](double v) { return std::bit_cast<std::uint64_t>(v); });
    return all;
}

/// Every number of a shape.
std::vector<double> numbers(const Shape& shape) {
    std::vector<double> all{area(shape), polar_moment(shape), outer_radius(shape), inner_radius(shape)};
    if (const auto* polygon = std::get_if<PolarPolygon>(&shape)) {
        for (const Vec2& vertex : polygon->vertices()) all.insert(all.end(), {vertex.x(), vertex.y()});
    }
    return all;
}

std::vector<double> numbers(const Wall& wall) {
    std::vector<double> all{wall.remove_at.value_or(-1.0)};
    for (const Vec2& point : wall.points) all.insert(all.end(), {point.x(), point.y()});
    for (const double time : {0.0, 0.1, 0.37}) {
        const WallState state = wall_state(wall, time);
        all.insert(all.end(), {state.pose.centre.x(), state.pose.centre.y(), state.pose.sine, state.velocity.x(),
                               state.velocity.y(), state.spin});
    }
    return all;
}

void expect_same_bits(const Scene& a, const Scene& b) {
    EXPECT_EQ(bits({a.gravity.x(), a.gravity.y()}), bits({b.gravity.x(), b.gravity.y()}));
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.threads, b.threads);
    const auto arrays = [](const Grains& g) {
        return std::vector{&g.x, &g.y, &g.angle, &g.vx, &g.vy, &g.spin, &g.mass, &g.inertia};
    };
    for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(bits(*arrays(a.grains)[k]), bits(*arrays(b.grains)[k])) << k;
    EXPECT_EQ(a.grains.shape, b.grains.shape);
    EXPECT_EQ(a.grains.material, b.grains.material);
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t k = 0; k < a.shapes.size(); ++k) {
        EXPECT_EQ(name(*a.shapes[k]), name(*b.shapes[k]));
        EXPECT_EQ(bits(numbers(*a.shapes[k])), bits(numbers(*b.shapes[k]))) << name(*a.shapes[k]);
    }
    ASSERT_EQ(a.walls.size(), b.walls.size());
    for (std::size_t k = 0; k < a.walls.size(); ++k) {
        EXPECT_EQ(a.walls[k].name, b.walls[k].name);
        EXPECT_EQ(a.walls[k].material, b.walls[k].material);
        EXPECT_EQ(bits(numbers(a.walls[k])), bits(numbers(b.walls[k]))) << a.walls[k].name;
    }
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (MaterialIndex m = 0; m < a.materials.size(); ++m) {
        EXPECT_EQ(bits({a.materials[m].density, a.materials[m].friction, a.materials[m].restitution.mean}),
                  bits({b.materials[m].density, b.materials[m].friction, b.materials[m].restitution.mean}));
        for (MaterialIndex n = 0; n < a.materials.size(); ++n) {
            EXPECT_EQ(bits({a.materials.pair(m, n).friction}), bits({b.materials.pair(m, n).friction}));
            EXPECT_EQ(a.materials.pair(m, n).restitution.has_value(), b.materials.pair(m, n).restitution.has_value());
        }
    }
}

class Shipped : public ::testing::TestWithParam<std::string> {};

TEST_P(Shipped, ResolvesToATextThatGivesTheSameScenarioBitForBit) {
    const Scenario first = load_scenario(find_scenario(GetParam()));
    const ScenarioFile file(first.resolved_toml);
    const Scenario again = load_scenario(file.path());
    expect_same_bits(first.scene, again.scene);
    EXPECT_EQ(first.resolved_toml, again.resolved_toml);
    EXPECT_EQ(first.title, again.title);
    EXPECT_EQ(first.run.time_step, again.run.time_step);
    EXPECT_EQ(first.settle.has_value(), again.settle.has_value());
    EXPECT_EQ(first.expectations.size(), again.expectations.size());
}

TEST_P(Shipped, StartsWithoutOverlapByAnIndependentCount) {
    const Scenario scenario = load_scenario(find_scenario(GetParam()));
    ASSERT_GT(scenario.scene.grains.size(), 0);
    // Before time zero: walls at rest and none removed.
    EXPECT_EQ(count_overlaps(scenario.scene, scenario.scene.grains, -1.0, 1e-12), 0);
}

TEST_P(Shipped, SaysWhatItIsAndWhereItComesFrom) {
    const Scenario scenario = load_scenario(find_scenario(GetParam()));
    EXPECT_THAT(scenario.title, Not(HasSubstr(GetParam()))) << "the title is to say more than the file's name";
    EXPECT_FALSE(scenario.source.empty());
    EXPECT_FALSE(scenario.expectations.empty()) << "what does a correct run show?";
    for (const Expectation& expectation : scenario.expectations) EXPECT_FALSE(expectation.source.empty());
    std::ifstream file(find_scenario(GetParam()));
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line.substr(0, 2), "# ") << "the file opens with what it is about";
}

std::vector<std::string> shipped_list() {
    std::vector<std::string> names;
    for (const ScenarioEntry& entry : shipped_scenarios()) names.push_back(entry.name);
    return names;
}

std::string scenario_name(const ::testing::TestParamInfo<std::string>& info) {
    std::string text = info.param;
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Shipped, ::testing::ValuesIn(shipped_list()), scenario_name);

TEST(ShippedScenarios, AreAllThere) {
    EXPECT_THAT(shipped_list(), ::testing::IsSupersetOf({"bin-rough", "bin-sticks", "chute", "domino-opalene",
                                                         "falling-star", "fig9", "pour-500-disks", "vibrating-floor"}));
}

TEST(ShippedScenarios, AreFoundByNameAndMisspeltOnesAreHinted) {
    EXPECT_EQ(find_scenario("bin-rough"), scenario_folder() / "bin-rough.toml");
    EXPECT_EQ(find_scenario("bin-rough.toml"), scenario_folder() / "bin-rough.toml");
    try {
        find_scenario("bin-roguh");
        FAIL() << "a scenario that is not there was found";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("did you mean the shipped \"bin-rough\"?"));
    }
}

TEST(Resolved, HoldsEveryDefaultAndEveryOverride) {
    const Scenario scenario = load_text(small_scenario(), {.set = {"run.gravity=0.1"}});
    for (const char* line : {"gravity = 0.1\n", "time_step = \"critical\"\n", "incline = 0.0\n", "threads = 1\n",
                             "angle = 0.0\n", "velocity = [0.0, 0.0]\n", "frames = { every = 0.01, format = \"png\""}) {
        EXPECT_THAT(scenario.resolved_toml, HasSubstr(line));
    }
}

TEST(Resolved, HoldsTheOutlineOfAFileAndNeedsTheFileNoMore) {
    const Scenario scenario = load_text(
        replaced(small_scenario(), "type = \"disk\"\nradius = 0.05", "type = \"file\"\npath = \"star\"\nscale = 3.0"));
    EXPECT_THAT(scenario.resolved_toml, Not(HasSubstr("path")));
    EXPECT_THAT(scenario.resolved_toml, HasSubstr("type = \"outline\""));
    expect_same_bits(scenario.scene, load_text(scenario.resolved_toml).scene);
}

TEST(Resolved, HasTheTableOfDemWithItsPairsWhereItMatters) {
    EXPECT_THAT(load_text(small_scenario()).resolved_toml, Not(HasSubstr("[dem]")));
    const Scenario scenario = load_text(small_scenario() + R"([dem]
law = "hertz"
stiffness = 1e11
integrator = "gear4"
search = "cgrid"
[[dem.pairs]]
between = ["rubber", "rubber"]
law = "walton-braun"
tension = true
)");
    const DemSettings& dem = scenario.engines.dem;
    EXPECT_EQ(dem.law.normal, NormalLaw::hertz);
    EXPECT_EQ(dem.law.stiffness, 1e11);
    EXPECT_EQ(dem.integrator, SoftIntegrator::gear4);
    EXPECT_EQ(dem.search, PairSearch::cgrid);
    ASSERT_EQ(dem.pairs.size(), 1u);
    EXPECT_EQ(dem.pairs[0].law.normal, NormalLaw::walton_braun);
    EXPECT_EQ(dem.pairs[0].law.stiffness, std::nullopt);
    EXPECT_TRUE(dem.pairs[0].law.tension);
    EXPECT_THAT(scenario.resolved_toml, HasSubstr("[[dem.pairs]]\nbetween = "));
    EXPECT_EQ(load_text(scenario.resolved_toml).resolved_toml, scenario.resolved_toml);
    EXPECT_THAT(load_text(small_scenario(), {.set = {}, .engine = "dem"}).resolved_toml, HasSubstr("resolution = 25"));
    EXPECT_THAT(complaint(small_scenario() + "[dem]\nexponent = 0.5\n"), HasSubstr("belongs to law"));
}

TEST(Resolved, HasTheTableOfBox2dWhereItMatters) {
    EXPECT_THAT(load_text(small_scenario()).resolved_toml, Not(HasSubstr("[box2d]")));
    const Scenario scenario = load_text(small_scenario() + "[box2d]\nskin = 0.01\nunit = 0.25\n");
    EXPECT_EQ(scenario.engines.box2d.skin, 0.01);
    EXPECT_EQ(scenario.engines.box2d.unit, 0.25);
    EXPECT_EQ(scenario.engines.box2d.restitution_threshold, std::nullopt);
    EXPECT_THAT(scenario.resolved_toml, HasSubstr("[box2d]\nvelocity_iterations = 8\n"));
    EXPECT_EQ(load_text(scenario.resolved_toml).resolved_toml, scenario.resolved_toml);
    EXPECT_THAT(load_text(small_scenario(), {.set = {}, .engine = "box2d"}).resolved_toml,
                HasSubstr("continuous = false\n"));
}

}  // namespace
}  // namespace polargrain::testing
