#include <gtest/gtest.h>

#include <charconv>
#include <map>

#include "src/core/error.h"
#include "src/observe/bed.h"
#include "src/record/series_csv.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::csv_rows;
using testing::report_at;
using testing::small_scene;
using testing::TemporaryFolder;
using testing::world_at;

Totals some_totals() {
    Totals totals;
    totals.ledger.restitution_loss = 0.125;
    totals.ledger.friction_loss = 0.0625;
    totals.ledger.wall_work = 0.5;
    totals.ledger.correction = 0.02;
    totals.ledger.created = 0.03;
    totals.ledger.rises = 0.04;
    totals.moves = {100, 7, 3};
    totals.impacts = 42;
    totals.steps = 4;
    return totals;
}

double as_number(const std::string& text) {
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// Writes a row at time zero and one after four steps, and returns the rows by column.
std::vector<std::map<std::string, std::string>> written(const Scene& scene, const std::filesystem::path& path) {
    constexpr double k_dt = 0.001;
    SeriesCsv series(path, 0.004);
    series.begin(scene, testing::run_info());
    const StepReport nothing;
    series.sample({scene, initial_world(scene), nothing, Totals{}});
    StepReport report;
    World world;
    for (std::int64_t step = 1; step <= 4; ++step) {
        report = report_at(scene, step);
        world = world_at(scene, step, k_dt);
        series.step(world, k_dt, report);
    }
    series.sample({scene, world, report, some_totals()});
    series.end();
    const auto rows = csv_rows(path);
    std::vector<std::map<std::string, std::string>> named;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        named.emplace_back();
        EXPECT_EQ(rows[r].size(), rows[0].size());
        for (std::size_t c = 0; c < rows[0].size(); ++c) named.back()[rows[0][c]] = rows[r].at(c);
    }
    return named;
}

TEST(SeriesCsv, ColumnsStandInTheOrderOfTheContract) {
    const TemporaryFolder folder("series-columns");
    const Scene scene = small_scene();
    written(scene, folder / "series.csv");
    const auto rows = csv_rows(folder / "series.csv");
    std::string header;
    for (const std::string& column : rows.at(0)) header += column + ' ';
    EXPECT_EQ(header,
              "time step kinetic_translational kinetic_rotational potential dissipated_normal dissipated_friction "
              "wall_work contacts impacts moves_rejected moves_shortened centre_of_mass_x centre_of_mass_y grains_in "
              "grains_out energy_correction energy_created energy_rises moves_tried energy_stored wall_floor_fx "
              "wall_floor_fy wall_floor_torque wall_shaker_fx "
              "wall_shaker_fy wall_shaker_torque wall_paddle_fx wall_paddle_fy wall_paddle_torque wall_gate_fx "
              "wall_gate_fy wall_gate_torque ");
}

TEST(SeriesCsv, EnergiesReadBackToTheSameBits) {
    const TemporaryFolder folder("series-bits");
    const Scene scene = small_scene();
    const auto rows = written(scene, folder / "series.csv");
    ASSERT_EQ(rows.size(), 2u);
    const World world = world_at(scene, 4, 0.001);
    const Energy expected = energy(world.grains, scene.gravity);
    EXPECT_EQ(as_number(rows[1].at("time")), world.time);
    EXPECT_EQ(as_number(rows[1].at("kinetic_translational")), expected.translational);
    EXPECT_EQ(as_number(rows[1].at("kinetic_rotational")), expected.rotational);
    EXPECT_EQ(as_number(rows[1].at("potential")), expected.potential);
}

TEST(SeriesCsv, SumsAndCountsAreThoseOfTheRun) {
    const TemporaryFolder folder("series-sums");
    const auto row = written(small_scene(), folder / "series.csv").at(1);
    const std::map<std::string, std::string> expected = {{"step", "4"},
                                                         {"dissipated_normal", "0.125"},
                                                         {"dissipated_friction", "0.0625"},
                                                         {"wall_work", "0.5"},
                                                         {"energy_correction", "0.02"},
                                                         {"energy_created", "0.03"},
                                                         {"energy_rises", "0.04"},
                                                         {"contacts", "1"},
                                                         {"impacts", "42"},
                                                         {"moves_rejected", "3"},
                                                         {"moves_tried", "100"},
                                                         {"moves_shortened", "7"},
                                                         {"grains_in", "4"},
                                                         {"grains_out", "0"}};
    for (const auto& [column, value] : expected) EXPECT_EQ(row.at(column), value) << column;
}

TEST(SeriesCsv, WallForceIsTheImpulseOfTheIntervalOverItsLength) {
    const TemporaryFolder folder("series-walls");
    const auto rows = written(small_scene(), folder / "series.csv");
    EXPECT_EQ(as_number(rows[0].at("wall_floor_fy")), 0.0);
    // Impulses -0.002 (1 + 2 + 3 + 4) N s/m within 4 ms.
    EXPECT_NEAR(as_number(rows[1].at("wall_floor_fy")), -5.0, 1e-12);
    EXPECT_NEAR(as_number(rows[1].at("wall_floor_fx")), 2.5, 1e-12);
    EXPECT_NEAR(as_number(rows[1].at("wall_gate_fx")), 4 * 2.5, 1e-12);
    EXPECT_NEAR(as_number(rows[1].at("wall_floor_torque")), 0.025, 1e-12);
}

TEST(SeriesCsv, CentreOfMassIsWeightedByMass) {
    const TemporaryFolder folder("series-centre");
    const Scene scene = small_scene();
    const auto row = written(scene, folder / "series.csv").at(0);
    double moment = 0.0, mass = 0.0;
    for (std::size_t k = 0; k < scene.grains.x.size(); ++k) {
        moment += scene.grains.mass[k] * scene.grains.x[k];
        mass += scene.grains.mass[k];
    }
    EXPECT_NEAR(as_number(row.at("centre_of_mass_x")), moment / mass, 1e-15);
}

TEST(SeriesCsv, EachRowIsOnDiskAtOnce) {
    const TemporaryFolder folder("series-flush");
    const Scene scene = small_scene();
    SeriesCsv series(folder / "series.csv", 0.1);
    series.begin(scene, testing::run_info());
    const StepReport nothing;
    series.sample({scene, initial_world(scene), nothing, Totals{}});
    EXPECT_EQ(csv_rows(folder / "series.csv").size(), 2u) << "before end()";
}

TEST(SeriesCsv, FolderThatIsNotThereIsNamed) {
    SeriesCsv series("/nowhere/at/all/series.csv", 0.1);
    try {
        series.begin(small_scene(), testing::run_info());
        FAIL() << "wrote into a folder that does not exist";
    } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("/nowhere/at/all/series.csv"), std::string::npos) << error.what();
    }
}

TEST(SeriesCsv, FullDiskEndsTheRunByName) {
    const Scene scene = small_scene();
    SeriesCsv series("/dev/full", 0.1);  // every write fails with "no space left on device"
    EXPECT_THROW(series.begin(scene, testing::run_info()), RunError);
}

TEST(CsvField, QuotesOnlyWhatNeedsIt) {
    EXPECT_EQ(csv_field("wall_floor_fx"), "wall_floor_fx");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("5\" pipe"), "\"5\"\" pipe\"");
}

TEST(GrainsOut, AGrainIsOutOnceItsCentreIsItsOwnRadiusBelowTheLowestWallPoint) {
    Scene scene = small_scene();
    scene.gravity = {0.0, -9.81};
    ASSERT_TRUE(outlet_height(scene));
    EXPECT_EQ(*outlet_height(scene), 0.0);
    Grains grains = scene.grains;
    EXPECT_EQ(count_out(scene, grains), 0);
    grains.y[0] = -0.0099;  // radius 0.01
    EXPECT_EQ(count_out(scene, grains), 0);
    grains.y[0] = -0.0101;
    EXPECT_EQ(count_out(scene, grains), 1);
}

TEST(GrainsOut, BelowIsAlongGravityWhateverItsDirection) {
    Scene scene = small_scene();
    scene.walls.resize(1);  // the floor from (0, 0) to (0.2, 0)
    scene.gravity = {9.81, 0.0};
    EXPECT_NEAR(*outlet_height(scene), -0.2, 1e-15);
    Grains grains = scene.grains;
    grains.x[1] = 0.2101;
    EXPECT_EQ(count_out(scene, grains), 1);
}

TEST(GrainsOut, WithoutWallsNothingIsOut) {
    Scene scene = small_scene();
    scene.walls.clear();
    Grains grains = scene.grains;
    grains.y[0] = -1e6;
    EXPECT_EQ(count_out(scene, grains), 0);
}

}  // namespace
}  // namespace polargrain
