#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_text.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;

std::string expect(const std::string& lines) { return small_scenario() + "[[expect]]\n" + lines; }

TEST(Expectations, CarryWhatNarrowsTheirObservableDown) {
    const Scenario scenario = load_text(expect(R"(quantity = "share_in_region"
label = "high"
shape = "ball"
material = "rubber"
started_in = [[-1.0, 0.0], [1.0, 2.0]]
region = [[-1.0, 0.5], [1.0, 2.0]]
statistic = "mean"
from = 0.5
to = 1.5
min = 20.0
unit = "%"
source = "here"
)"));
    ASSERT_EQ(scenario.expectations.size(), 1U);
    const Expectation& e = scenario.expectations[0];
    EXPECT_EQ(e.observable.quantity, "share_in_region");
    EXPECT_EQ(e.observable.label, "high");
    EXPECT_EQ(e.observable.shape, "ball");
    EXPECT_EQ(e.observable.material, "rubber");
    ASSERT_TRUE(e.observable.region && e.observable.started_in);
    EXPECT_EQ(e.observable.region->lower, Vec2(-1.0, 0.5));
    EXPECT_EQ(e.observable.started_in->upper, Vec2(1.0, 2.0));
    EXPECT_EQ(e.statistic, Statistic::mean);
    EXPECT_EQ(e.from, 0.5);
    EXPECT_EQ(e.to, 1.5);
    EXPECT_EQ(e.unit, "%");
    const Scenario again = load_text(scenario.resolved_toml);
    EXPECT_EQ(again.resolved_toml, scenario.resolved_toml);
}

TEST(Expectations, AreRefusedWithTheRemedy) {
    const auto refused = [](const std::string& lines) { return complaint(expect(lines)); };
    EXPECT_THAT(refused("quantity = \"grains_uot\"\nmin = 1"), HasSubstr("did you mean \"grains_out\"?"));
    EXPECT_THAT(refused("quantity = \"wall_pressure\"\nmin = 1"),
                HasSubstr("wall_pressure needs to know more: give wall"));
    EXPECT_THAT(refused("quantity = \"wall_pressure\"\nwall = \"flor\"\nmin = 1"),
                HasSubstr("did you mean \"floor\"?"));
    EXPECT_THAT(refused("quantity = \"area_fraction\"\nopening = [[0, 0], [1, 0]]\nmin = 1"),
                HasSubstr("does not take opening"));
    EXPECT_THAT(refused("quantity = \"deepest_overlap\"\nmax = 1\nunit = \"mm/s\""),
                HasSubstr("case.toml:26:8: expect[0].unit: \"mm/s\" is no unit of deepest_overlap; give one of \"m\", "
                          "\"mm\", \"d\""));
    EXPECT_THAT(refused("quantity = \"area_fraction\"\nfrom = 1\nto = 0.5\nmin = 1"), HasSubstr("swap them"));
    EXPECT_THAT(refused("quantity = \"area_fraction\"\nstatistic = \"meen\"\nmin = 1"), HasSubstr("mean"));
    EXPECT_THAT(refused("quantity = \"stress_xx\"\nregion = [[1, 1], [0, 2]]\nmin = 1"),
                HasSubstr("lower left and the upper right"));
    EXPECT_THAT(refused("quantity = \"bridges\"\nopening = [[1, 1], [1, 1]]\nmin = 1"), HasSubstr("coincide"));
}

TEST(Expectations, RefuseAUnitThatTheSceneMakesZero) {
    const std::string text = replaced(expect("quantity = \"kinetic_energy_per_grain\"\nmax = 1\nunit = \"m g d\"\n"),
                                      "duration = 2.0", "duration = 2.0\ngravity = 0.0");
    EXPECT_THAT(complaint(text), HasSubstr("\"m g d\" is zero in this scene, which has no gravity; give \"J/m\""));
}

std::string observe(const std::string& list) { return small_scenario() + "[output]\nobserve = " + list + "\n"; }

TEST(Observe, TakesNamesAndTables) {
    const Scenario scenario = load_text(
        observe("[\"area_fraction\", { quantity = \"bridges\", label = \"arches\", opening = [[0, 0], [1, 0]] }]"));
    ASSERT_EQ(scenario.output.observe.size(), 2U);
    EXPECT_EQ(scenario.output.observe[0].label, "area_fraction");
    EXPECT_EQ(scenario.output.observe[1].label, "arches");
    EXPECT_EQ(scenario.output.observe[1].opening.value().to, Vec2(1.0, 0.0));
    EXPECT_THAT(scenario.resolved_toml,
                HasSubstr("observe = [{ quantity = \"area_fraction\" }, { quantity = \"bridges\""));
    EXPECT_EQ(load_text(scenario.resolved_toml).resolved_toml, scenario.resolved_toml);
}

TEST(Observe, IsRefusedWithTheRemedy) {
    EXPECT_THAT(complaint(observe("\"area_fraction\"")), HasSubstr("must be a list"));
    EXPECT_THAT(complaint(observe("[3]")), HasSubstr("output.observe[0] is a number, must be a name or a table"));
    EXPECT_THAT(complaint(observe("[\"area_fractoin\"]")), HasSubstr("did you mean \"area_fraction\"?"));
    EXPECT_THAT(complaint(observe("[\"grains_out\"]")), HasSubstr("a column \"grains_out\" already"));
    EXPECT_THAT(complaint(observe("[\"area_fraction\", \"area_fraction\"]")), HasSubstr("a label of its own"));
    EXPECT_THAT(complaint(observe("[{ quantity = \"grains_out\", labl = \"x\" }]")),
                HasSubstr("did you mean \"label\"?"));
    EXPECT_THAT(complaint(observe("[{ quantity = \"grains_out\", label = \"a b\" }]")), HasSubstr("letters, digits"));
}

TEST(Observe, LabelsThatAreColumnsOfEveryRunAreRefused) {
    for (const std::string label : {"time", "energy_stored", "wall_floor_fx"}) {
        EXPECT_THAT(complaint(observe("[{ quantity = \"area_fraction\", label = \"" + label + "\" }]")),
                    HasSubstr("output.observe[0]: series.csv has a column \"" + label + "\" already"));
    }
}

}  // namespace
}  // namespace polargrain::testing
