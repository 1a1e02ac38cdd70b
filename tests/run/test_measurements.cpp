#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/run/measurements.h"
#include "src/run/simulation.h"
#include "tests/run/falling_engine.h"

namespace polargrain {
namespace {

using testing::ElementsAre;

Expectation expecting(const std::string& quantity, Statistic statistic = Statistic::last) {
    Expectation e;
    e.observable.quantity = quantity;
    e.statistic = statistic;
    return e;
}

TEST(ExpectationLabels, AreTheQuantityAndKeepApartWhatDiffers) {
    Expectation labelled = expecting("centre_of_mass_y");
    labelled.observable.label = "height";
    Expectation windowed = expecting("grains_out");
    windowed.to = 0.5;
    EXPECT_THAT(expectation_labels({expecting("area_fraction"), expecting("area_fraction"), windowed, labelled,
                                    expecting("centre_of_mass_y", Statistic::mean),
                                    expecting("centre_of_mass_y", Statistic::mean), expecting("centre_of_mass_x")}),
                ElementsAre("area_fraction", "area_fraction", "grains_out_2", "height", "centre_of_mass_y_mean",
                            "centre_of_mass_y_mean_2", "centre_of_mass_x"));
}

/// A disk that falls freely from 10 m for a second, read every tenth of it.
std::map<std::string, double> measured(const std::vector<Expectation>& expectations) {
    const Scene scene = one_disk(10.0, false);
    FallingEngine engine(scene);
    Measurements measurements(expectations, 0.1);
    Simulation simulation(scene, engine, describe_run(scene, engine, 0.01, 1.0));
    simulation.add(measurements);
    simulation.run({});
    return measurements.values();
}

TEST(Measurements, GiveTheStandardObservablesAndTheExpectedOnes) {
    const auto y = [](double t) { return 10.0 - 0.5 * 9.81 * t * t; };
    Expectation late = expecting("centre_of_mass_y", Statistic::mean);
    late.from = 0.75;
    Expectation change = expecting("centre_of_mass_y", Statistic::change);
    change.to = 0.55;
    Expectation too_late = expecting("centre_of_mass_x");
    too_late.from = 5.0;
    const auto values = measured({expecting("centre_of_mass_y"), late, change, too_late});
    EXPECT_EQ(values.count("centre_of_mass_x_2"), 0U) << "the run is over before it begins";
    EXPECT_NEAR(values.at("centre_of_mass_y"), y(1.0), 1e-9);
    EXPECT_NEAR(values.at("centre_of_mass_y_mean"), (y(0.8) + y(0.9) + y(1.0)) / 3.0, 1e-9);
    EXPECT_NEAR(values.at("centre_of_mass_y_change"), y(0.5) - y(0.0), 1e-9);
    EXPECT_EQ(values.at("deepest_overlap"), 0.0);
    EXPECT_EQ(values.at("moves_rejected_percent"), 0.0);
    EXPECT_EQ(values.count("area_fraction"), 0U) << "no walls: it has no value";
}

TEST(Measurements, GoOnFromACheckpoint) {
    const Scene scene = one_disk(10.0, true);
    const std::vector<Expectation> expectations = {expecting("centre_of_mass_y", Statistic::mean)};
    FallingEngine engine(scene);
    Measurements whole(expectations, 0.1);
    Checkpoint saved;
    const auto steps = [&](Measurements& measurements, int first, int last) {
        World world = initial_world(scene);
        const StepReport report;
        for (world.step = first; world.step <= last; ++world.step) {
            world.time = 0.1 * static_cast<double>(world.step);
            world.grains.y[0] = 1.0 / static_cast<double>(world.step);
            measurements.step(world, 0.1, report);
            measurements.sample({scene, world, report, Totals{}});
        }
    };
    const RunInfo info = describe_run(scene, engine, 0.1, 1.0);
    whole.begin(scene, info);
    steps(whole, 1, 5);
    whole.save(saved);
    steps(whole, 6, 10);
    Measurements again(expectations, 0.7);  // as for a run that is to take longer
    again.resume(scene, info, saved);
    EXPECT_EQ(again.every(), 0.1);
    steps(again, 6, 10);
    EXPECT_EQ(again.values(), whole.values());
    EXPECT_GT(whole.values().size(), 4U);
}

}  // namespace
}  // namespace polargrain
