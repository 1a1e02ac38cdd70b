#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "src/core/error.h"
#include "src/observe/deepest_overlap.h"
#include "src/observe/observer.h"
#include "src/observe/reduction.h"
#include "tests/observe/observed.h"
#include "tests/support/scenes.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;

std::string complaint(const std::function<void(ObservableSpec&)>& change, const std::string& quantity) {
    Scene scene = disks_at({{0.05, 0.02}, {0.07, 0.02}});
    add_open_box(scene, 0.2, 1.0);
    ObservableSpec spec;
    spec.quantity = quantity;
    change(spec);
    try {
        check_observable(spec, scene);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CheckObservable, SaysWhatIsWrong) {
    const auto nothing = [](ObservableSpec&) {};
    EXPECT_THAT(complaint(nothing, "area_fracton"), HasSubstr("did you mean \"area_fraction\"?"));
    EXPECT_THAT(complaint(nothing, "bridges"), HasSubstr("give opening"));
    EXPECT_THAT(complaint(nothing, "mixing_index"), HasSubstr("give shape or material or started_in"));
    EXPECT_THAT(complaint([](ObservableSpec& s) { s.cell = 0.1; }, "area_fraction"), HasSubstr("does not take cell"));
    EXPECT_THAT(complaint([](ObservableSpec& s) { s.wall = "bax"; }, "wall_pressure"),
                HasSubstr("no wall \"bax\" here; did you mean \"box\"?"));
    EXPECT_THAT(complaint([](ObservableSpec& s) { s.shape = "square"; }, "purity"), HasSubstr("there are: disk"));
    EXPECT_EQ(complaint([](ObservableSpec& s) { s.wall = "box"; }, "wall_pressure"), "");
}

TEST(CheckObservable, SaysWhatAMeterItselfRefuses) {
    Scene scene = disks_at({{0.05, 0.02}, {0.07, 0.02}});
    add_open_box(scene, 0.2, 1.0);
    scene.gravity = Vec2::Zero();
    ObservableSpec spec;
    spec.quantity = "bridges";
    spec.opening = Opening{{0.05, 0.0}, {0.1, 0.0}};
    EXPECT_THROW(check_observable(spec, scene), InputError);
}

/// Enough of a specification for any observable.
ObservableSpec full_spec(const ObservableEntry& entry) {
    ObservableSpec spec;
    spec.quantity = entry.name;
    if ((entry.needs & k_region) != 0) spec.region = Region{{0.0, 0.0}, {0.2, 0.2}};
    if ((entry.needs & k_kind) != 0) spec.started_in = Region{{0.0, 0.0}, {0.06, 0.2}};
    if ((entry.needs & k_opening) != 0) spec.opening = Opening{{0.05, 0.0}, {0.1, 0.0}};
    if ((entry.needs & k_wall) != 0) spec.wall = "box";
    return spec;
}

/// What a hundred steps of made-up motion read at the end; with a checkpoint taken half way on request.
std::vector<double> readings(const ObservableSpec& spec, bool interrupted) {
    Scene scene = pour(PourShape::mixed, 30, 1, 0.3, 0.3, 10);
    scene.walls.clear();
    add_open_box(scene, 0.2, 1.0);
    auto observer = std::make_unique<Observer>(spec, scene);
    World world = initial_world(scene);
    StepReport report;
    Totals totals;
    std::vector<double> values;
    for (int step = 1; step <= 100; ++step) {
        world.step = step;
        world.time = 1e-3 * step;
        for (double& y : world.grains.y) y -= 0.005;
        for (double& angle : world.grains.angle) angle += 0.01;
        report.clear(1);
        for (GrainIndex k = 0; k + 1 < 30; ++k) {
            Contact c = press({{}, {}, {}, world.grains, scene.gravity, 1, 1}, k, k + 1, 1e-4 * (k % 5 + step % 3));
            report.contacts.push_back(c);
        }
        report.contacts.push_back({wall_body(0), 3, {0.03, 0.0}, {0.0, 1.0}, 0.0, {0.0, 1e-3}});
        report.moves.tried = 30;
        totals.moves += report.moves;
        totals.steps += 1;
        totals.contact_sum += 30;
        observer->step(world, 1e-3, report);
        if (interrupted && step == 50) {
            Checkpoint saved;
            observer->save(saved, "x");
            observer = std::make_unique<Observer>(spec, scene);
            observer->load(saved, "x");
        }
        if (step % 30 == 0 || step == 100) values.push_back(observer->read({scene, world, report, totals}));
    }
    return values;
}

class EveryObservable : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryObservable, GoesOnFromACheckpointWithTheSameBits) {
    const ObservableSpec spec = full_spec(*find_observable(GetParam()));
    const std::vector<double> whole = readings(spec, false);
    const std::vector<double> resumed = readings(spec, true);
    for (std::size_t k = 0; k < whole.size(); ++k) {
        EXPECT_TRUE(whole[k] == resumed[k] || (std::isnan(whole[k]) && std::isnan(resumed[k])))
            << whole[k] << " and " << resumed[k];
    }
}

TEST_P(EveryObservable, HasAUnitAndALine) {
    const ObservableEntry& entry = *find_observable(GetParam());
    EXPECT_FALSE(units_of(entry.dimension).empty());
    EXPECT_GT(entry.line.size(), 10U);
    EXPECT_TRUE(!entry.standard || entry.needs == 0) << "a standard observable is told nothing";
}

INSTANTIATE_TEST_SUITE_P(Table, EveryObservable, ::testing::ValuesIn(observable_names()),
                         [](const auto& named) { return named.param; });

TEST(Units, ConvertByTheScene) {
    Scene scene = disks_at({{0.0, 0.0}}, 0.01);
    EXPECT_DOUBLE_EQ(unit_scale(Dimension::length, "d", scene).value(), 0.02);
    EXPECT_DOUBLE_EQ(unit_scale(Dimension::length, "mm", scene).value(), 1e-3);
    EXPECT_DOUBLE_EQ(unit_scale(Dimension::energy, "m g d", scene).value(), scene.grains.mass[0] * 9.81 * 0.02);
    EXPECT_NEAR(unit_scale(Dimension::area_rate, "sqrt(g) d^1.5", scene).value(), std::sqrt(9.81) * std::pow(0.02, 1.5),
                1e-15);
    EXPECT_DOUBLE_EQ(unit_scale(Dimension::pressure, "rho g d", scene).value(), 2000.0 * 9.81 * 0.02);
    EXPECT_DOUBLE_EQ(unit_scale(Dimension::pressure, "", scene).value(), 1.0);
    EXPECT_FALSE(unit_scale(Dimension::pressure, "mm", scene));
}

TEST(Reduction, MakesOneNumberOfReadings) {
    const auto value = [](Statistic statistic) {
        Reduction reduction(statistic, 1.0, 3.0);
        for (const auto& [time, reading] :
             {std::pair{0.5, 100.0}, {1.0, 4.0}, {2.0, std::nan("")}, {2.5, 1.0}, {3.0, 7.0}, {3.5, -50.0}}) {
            reduction.add(time, reading);
        }
        return reduction.value();
    };
    EXPECT_DOUBLE_EQ(value(Statistic::last), 7.0);
    EXPECT_DOUBLE_EQ(value(Statistic::mean), 4.0);
    EXPECT_DOUBLE_EQ(value(Statistic::minimum), 1.0);
    EXPECT_DOUBLE_EQ(value(Statistic::maximum), 7.0);
    EXPECT_DOUBLE_EQ(value(Statistic::change), 3.0);
    EXPECT_TRUE(std::isnan(Reduction(Statistic::mean, {}, {}).value()));
}

TEST(DeepestOverlap, IsTheDepthOfTheDeepestVertexOrPoint) {
    Scene scene = disks_at({{0.0, 0.01}, {0.018, 0.01}}, 0.01);
    EXPECT_NEAR(deepest_overlap(scene, initial_world(scene)), 0.002, 1e-12);
    scene.walls.push_back({"floor", 0, {{-1.0, 0.003}, {1.0, 0.003}}, {}, std::nullopt});
    EXPECT_NEAR(deepest_overlap(scene, initial_world(scene)), 0.003, 1e-12);

    Scene boxes = empty_scene(0.0, 0.0);
    const ShapeIndex box = add_rectangle(boxes, 0.02, 0.02);
    boxes.add(Grain{box, 0, {0.0, 0.0}});
    boxes.add(Grain{box, 0, {0.0195, 0.0005}});
    EXPECT_NEAR(deepest_overlap(boxes, initial_world(boxes)), 0.0005, 1e-12);
    boxes.grains.x[1] = 0.021;
    EXPECT_EQ(deepest_overlap(boxes, initial_world(boxes)), 0.0);

    // A disk on a box, a hair inside of its corner, then with its centre inside.
    boxes.add(Grain{add_disk(boxes, 0.01), 0, {0.0099, 0.0195}});
    boxes.grains.x[1] = 0.5;
    EXPECT_NEAR(deepest_overlap(boxes, initial_world(boxes)), 0.0005, 1e-12);
    boxes.grains.x[2] = 0.0095;
    boxes.grains.y[2] = 0.009;
    EXPECT_NEAR(deepest_overlap(boxes, initial_world(boxes)), 0.0105, 1e-12);
}

/// Grains that fall through a line a step at a time, one of them beside it.
TEST(Flow, CountsWhatPassesAnOpeningAndWhatComesBack) {
    Scene scene = disks_at({{0.01, 0.035}, {0.03, 0.055}, {0.5, 0.035}}, 0.01);
    ObservableSpec spec;
    spec.opening = Opening{{0.0, 0.0}, {0.04, 0.0}};
    spec.quantity = "grains_passed";
    Observer passed(spec, scene);
    spec.quantity = "flow_rate";
    Observer rate(spec, scene);
    World world = initial_world(scene);
    const StepReport report;
    const Totals totals;
    const auto step = [&](double dy) {
        for (double& y : world.grains.y) y += dy;
        passed.step(world, 0.5, report);
        rate.step(world, 0.5, report);
    };
    for (int k = 0; k < 10; ++k) step(-0.01);
    EXPECT_EQ(passed.read({scene, world, report, totals}), 2.0);
    EXPECT_DOUBLE_EQ(rate.read({scene, world, report, totals}), 2.0 * k_pi * 1e-4 / 5.0);
    step(0.05);
    EXPECT_EQ(passed.read({scene, world, report, totals}), 1.0);
    EXPECT_DOUBLE_EQ(rate.read({scene, world, report, totals}), -k_pi * 1e-4 / 0.5);
}

}  // namespace
}  // namespace polargrain::testing
