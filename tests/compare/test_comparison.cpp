#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/compare/comparison.h"
#include "src/compare/jitter.h"
#include "src/engines/box2d/box2d_engine.h"
#include "src/engines/contact/contact_engine.h"
#include "src/run/measurements.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using ::testing::HasSubstr;
using testing::PourShape;

constexpr double k_dt = 1e-3;

/// How long the flow of this scene is looked at [s].
constexpr double k_duration = 0.3;

Track follow_with(std::unique_ptr<Engine> (*make)(const Scene&), const Scene& scene, double dt = k_dt) {
    const auto engine = make(scene);
    Meters meters(scene, {}, {}, k_duration);
    bool interrupted = true;
    Track track =
        follow(scene, *engine, dt, k_duration, meters, {.every = 0.01, .moments_every = 0.1}, {}, interrupted);
    EXPECT_FALSE(interrupted);
    return track;
}

std::size_t index_of(const Track& track, const std::string& name) {
    for (std::size_t q = 0; q < track.quantities.size(); ++q) {
        if (track.quantities[q].name == name) return q;
    }
    ADD_FAILURE() << name;
    return 0;
}

TEST(Track, IsTakenOnOneClockWhateverTheStep) {
    const Scene scene = testing::pour(PourShape::rough, 20, 3, 0.3, 0.4, 10);
    const Track a = follow_with(make_contact, scene, 1e-3);
    const Track b = follow_with(make_box2d, scene, 7e-4);
    EXPECT_EQ(a.readings.size(), 31U);
    EXPECT_EQ(b.readings.size(), 31U);
    EXPECT_EQ(a.moments.size(), 4U);
    EXPECT_EQ(b.moments.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(a.moments[k].world.time, 0.1 * static_cast<double>(k), 1e-3);
        EXPECT_NEAR(b.moments[k].world.time, 0.1 * static_cast<double>(k), 7e-4);
    }
    // The same initial state, bit for bit.
    for (std::size_t q = 0; q < a.quantities.size(); ++q) {
        if (!std::isfinite(a.readings[0][q])) continue;
        EXPECT_EQ(a.readings[0][q], b.readings[0][q]) << a.quantities[q].name;
    }
    EXPECT_EQ(state_hash(a.moments[0].world), state_hash(b.moments[0].world));
}

TEST(Meters, MeasureTheOverlapOfOutlinesNotWhatTheEngineBelieves) {
    // Two squares that overlap by a tenth of a side, and an engine that leaves them so.
    class Idle final : public Engine {
    public:
        std::string_view name() const override { return "idle"; }
        double suggested_dt() const override { return 1.0; }
        void step(World& world, double dt, StepReport& report) override {
            report.clear(0);
            ++world.step;
            world.time = static_cast<double>(world.step) * dt;
        }
        void save(Checkpoint&) const override {}
        void load(const Checkpoint&) override {}
    } idle;
    Scene scene = testing::empty_scene(0.5, 0.5, 0.0);
    const ShapeIndex square = testing::add_rectangle(scene, 0.1, 0.1);
    scene.add(Grain{square, 0, {0.0, 0.0}, 0.0, {0.0, 0.0}, 0.0});
    scene.add(Grain{square, 0, {0.09, 0.02}, 0.0, {0.0, 0.0}, 0.0});
    Meters meters(scene, {}, {}, 1.0);
    bool interrupted = false;
    const Track track = follow(scene, idle, 0.1, 1.0, meters, {.every = 0.1}, {}, interrupted);
    const double diameter = 0.1 * std::sqrt(2.0);
    EXPECT_NEAR(track.values[index_of(track, "overlap_percent_of_diameter")], 100.0 * 0.01 / diameter, 1e-6);
}

TEST(Meters, TakeEveryExpectationUnderTheNameThatARunGivesIt) {
    Scene scene = testing::empty_scene(0.5, 0.5, 0.0);
    scene.add(Grain{testing::add_disk(scene, 0.01), 0});
    std::vector<Expectation> expectations(3);
    for (Expectation& e : expectations) e.observable.quantity = "share_in_region";
    for (std::size_t k = 0; k < 3; ++k) expectations[k].observable.region = Region{{0.0, 0.0}, {1.0, 1.0 + double(k)}};
    const Meters meters(scene, expectations, {}, 1.0);
    std::vector<std::string> names;
    for (const Quantity& quantity : meters.quantities()) names.push_back(quantity.name);
    for (const std::string& label : expectation_labels(expectations)) {
        EXPECT_EQ(std::ranges::count(names, label), 1) << label;
    }
}

TEST(Jitter, MovesNothingAndGivesEverySeedItsOwnVelocities) {
    const Scene still = testing::pour(PourShape::disk, 200, 3, 0.3, 0.4, 10);
    Scene one = still, same = still, other = still;
    other.seed = still.seed + 1;
    for (Scene* scene : {&one, &same, &other}) add_jitter(*scene);
    EXPECT_EQ(one.grains.x, still.grains.x);
    EXPECT_EQ(one.grains.vx, same.grains.vx);
    EXPECT_NE(one.grains.vx, other.grains.vx);
    double squares = 0.0;
    for (GrainIndex k = 0; k < 200; ++k) squares += (one.grains.velocity(k) - still.grains.velocity(k)).squaredNorm();
    EXPECT_NEAR(std::sqrt(squares / 400.0) / (k_jitter * std::sqrt(9.81 * 0.01)), 1.0, 0.1);
}

class ComparisonOfTwo : public ::testing::Test {
protected:
    ComparisonOfTwo()
        : folder_(std::filesystem::temp_directory_path() / ("polargrain-compare-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
        comparison_.title = "Two engines";
        comparison_.initial_states = "Each seed draws its own.";
        comparison_.clock.every = 0.01;
        comparison_.engines = {"contact", "box2d"};
        comparison_.notes = {{}, {"something is left out"}};
        comparison_.tracks.resize(2);
        for (const std::uint64_t seed : {3U, 4U, 5U}) {
            const Scene scene = testing::pour(PourShape::rough, 20, seed, 0.3, 0.4, 10);
            comparison_.tracks[0].push_back(follow_with(make_contact, scene));
            comparison_.tracks[1].push_back(follow_with(make_box2d, scene));
        }
    }
    ~ComparisonOfTwo() override { std::filesystem::remove_all(folder_); }

    std::vector<std::string> lines(const char* file) const {
        std::ifstream in(folder_ / file);
        std::vector<std::string> all;
        for (std::string line; std::getline(in, line);) all.push_back(line);
        return all;
    }

    std::filesystem::path folder_;
    Comparison comparison_;
};

TEST_F(ComparisonOfTwo, ReportsCostsVerdictsAndWhatIsLeftOut) {
    const std::string text = report_text(comparison_);
    EXPECT_THAT(text, HasSubstr("2 engines on the same initial states, bit for bit, over 3 seeds."));
    EXPECT_THAT(text, HasSubstr("| contact | 0.001 | 300 |"));
    EXPECT_THAT(text, HasSubstr("| centre_of_mass_y [m] | contact | "));
    EXPECT_THAT(text, HasSubstr("- box2d: something is left out"));
    EXPECT_THAT(text, HasSubstr("Zero or without value in all runs: `flow_stopped`"));
    // Both fall the same way at first: the centres of mass end within the spread of their initial heights.
    const std::size_t q = index_of(comparison_.tracks[0][0], "centre_of_mass_y");
    EXPECT_EQ(compare_means(comparison_.spread(0, q), comparison_.spread(1, q)).agreement, Agreement::within_spread);
}

TEST_F(ComparisonOfTwo, WritesARowForEachRunAndTick) {
    write_tables(comparison_, folder_);
    const auto values = lines("values.csv");
    ASSERT_EQ(values.size(), 7U);
    EXPECT_EQ(values[0].rfind("engine,seed,time_step,steps,cpu_seconds_per_simulated_second,state_hash,", 0), 0U);
    EXPECT_EQ(values[1].rfind("contact,3,0.001,300,", 0), 0U);
    EXPECT_EQ(values[6].rfind("box2d,5,0.001,300,", 0), 0U);
    EXPECT_EQ(lines("series.csv").size(), 1U + 6U * 31U);
}

}  // namespace
}  // namespace polargrain
