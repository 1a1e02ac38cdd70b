#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/core/error.h"
#include "src/run/simulation.h"
#include "src/run/time_step.h"
#include "tests/run/falling_engine.h"

namespace polargrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Recorder : public Sink {
public:
    explicit Recorder(double every) : every_(every) {}
    double every() const override { return every_; }
    void begin(const Scene&, const RunInfo& info) override { info_ = info; }
    void step(const World&, double, const StepReport&) override { ++steps_; }
    void sample(const Sample& sample) override {
        sampled_steps_.push_back(sample.world.step);
        heights_.push_back(sample.world.grains.y[0]);
        last_totals_ = sample.totals;
        steps_seen_before_sample_.push_back(steps_);
    }
    void end() override { ++ends_; }

    double every_;
    RunInfo info_;
    std::int64_t steps_ = 0;
    int ends_ = 0;
    std::vector<std::int64_t> sampled_steps_, steps_seen_before_sample_;
    std::vector<double> heights_;
    Totals last_totals_;
};

RunInfo seconds(double duration, double dt) {
    RunInfo info;
    info.duration = duration;
    info.dt = dt;
    return info;
}

TEST(Simulation, FallsFreelyForTheDuration) {
    const Scene scene = one_disk(2.0, false);
    FallingEngine engine(scene);
    Simulation simulation(scene, engine, seconds(0.5, 1e-3));
    EXPECT_EQ(simulation.run({}), Ending::completed);
    EXPECT_EQ(simulation.state().world.step, 500);
    EXPECT_DOUBLE_EQ(simulation.state().world.time, 0.5);
    EXPECT_NEAR(simulation.state().world.grains.y[0], 2.0 - 0.5 * 9.81 * 0.25, 1e-12);
}

TEST(Simulation, SamplesAtZeroAtTheFirstStepAfterEachMultipleAndOnceAtTheEnd) {
    const Scene scene = one_disk(1.0, false);
    FallingEngine engine(scene);
    Recorder uneven(0.25), even(0.4), ends_only(0.0);
    Simulation simulation(scene, engine, seconds(1.0, 0.1));
    for (Recorder* sink : {&uneven, &even, &ends_only}) simulation.add(*sink);
    simulation.run({});
    EXPECT_THAT(uneven.sampled_steps_, ElementsAre(0, 3, 5, 8, 10));
    EXPECT_THAT(even.sampled_steps_, ElementsAre(0, 4, 8, 10));
    EXPECT_THAT(ends_only.sampled_steps_, ElementsAre(0, 10));
    for (const Recorder* sink : {&uneven, &even, &ends_only}) {
        EXPECT_EQ(sink->ends_, 1);
        EXPECT_EQ(sink->steps_seen_before_sample_, sink->sampled_steps_) << "a sink sees the step before its sample";
    }
}

TEST(Simulation, SamplesOncePerStepWhereTheIntervalIsShorterThanTheStep) {
    const Scene scene = one_disk(1.0, false);
    FallingEngine engine(scene);
    Recorder often(0.01);
    Simulation simulation(scene, engine, seconds(0.3, 0.1));
    simulation.add(often);
    simulation.run({});
    EXPECT_THAT(often.sampled_steps_, ElementsAre(0, 1, 2, 3));
}

TEST(Simulation, RoundOffInTheTimeDoesNotShiftASample) {
    // 0.002 and 0.0001 have no exact binary form; over 10^5 steps their multiples part by many last bits.
    const Scene scene = one_disk(1.0, false);
    FallingEngine engine(scene);
    Recorder sink(0.002);
    Simulation simulation(scene, engine, seconds(10.0, 1e-4));
    simulation.add(sink);
    simulation.run({});
    ASSERT_EQ(sink.sampled_steps_.size(), 5001U);
    for (std::size_t k = 0; k < sink.sampled_steps_.size(); ++k) {
        ASSERT_EQ(sink.sampled_steps_[k], static_cast<std::int64_t>(20 * k));
    }
}

TEST(Simulation, TotalsAreSumsOverSteps) {
    const Scene scene = one_disk(0.0, true);
    FallingEngine engine(scene);
    Recorder sink(0.0);
    Simulation simulation(scene, engine, seconds(0.01, 1e-3));
    simulation.add(sink);
    simulation.run({});
    EXPECT_EQ(sink.last_totals_.steps, 10);
    EXPECT_EQ(sink.last_totals_.impacts, 20);
    EXPECT_EQ(sink.last_totals_.moves.tried, 10);
    EXPECT_EQ(sink.last_totals_.contact_sum, 10);
    EXPECT_DOUBLE_EQ(sink.last_totals_.ledger.friction_loss, 5.0);
    EXPECT_DOUBLE_EQ(sink.last_totals_.deepest, 1.0) << "the deepest of all steps, not of the last";
}

TEST(Simulation, StopsBetweenTwoStepsWithALastSample) {
    const Scene scene = one_disk(1.0, false);
    FallingEngine engine(scene);
    std::atomic<bool> stop = false;
    class StopAtSeven : public Recorder {
    public:
        explicit StopAtSeven(std::atomic<bool>& stop) : Recorder(0.0), stop_(stop) {}
        void step(const World& world, double, const StepReport&) override {
            if (world.step == 7) stop_ = true;
        }
        std::atomic<bool>& stop_;
    } sink(stop);
    Simulation simulation(scene, engine, seconds(1.0, 0.01));
    simulation.add(sink);
    EXPECT_EQ(simulation.run({.stop = &stop, .progress = {}}), Ending::interrupted);
    EXPECT_THAT(sink.sampled_steps_, ElementsAre(0, 7));
    EXPECT_EQ(sink.ends_, 1);
}

TEST(Simulation, StoppedBeforeTheFirstStepSamplesTimeZeroOnce) {
    const Scene scene = one_disk(1.0, false);
    FallingEngine engine(scene);
    const std::atomic<bool> stop = true;
    Recorder sink(0.1);
    Simulation simulation(scene, engine, seconds(1.0, 0.01));
    simulation.add(sink);
    EXPECT_EQ(simulation.run({.stop = &stop, .progress = {}}), Ending::interrupted);
    EXPECT_THAT(sink.sampled_steps_, ElementsAre(0));
}

TEST(Simulation, ReportsProgressWhileItRuns) {
    const Scene scene = one_disk(1.0, false);
    FallingEngine engine(scene);
    std::vector<Progress> calls;
    std::atomic<bool> stop = false;
    const auto listen = [&](const Progress& progress) {
        calls.push_back(progress);
        stop = calls.size() == 2;
    };
    Simulation simulation(scene, engine, seconds(1e6, 1e-3));
    simulation.run({.stop = &stop, .progress = listen});
    ASSERT_EQ(calls.size(), 2U);
    EXPECT_LT(calls[0].time, calls[1].time);
    EXPECT_DOUBLE_EQ(calls[1].time, static_cast<double>(calls[1].steps) * 1e-3);
    EXPECT_DOUBLE_EQ(calls[1].end, 1e6);
    EXPECT_NEAR(calls[1].seconds_left * calls[1].steps_per_second, 1e9 - static_cast<double>(calls[1].steps), 1.0);
}

TEST(DescribeRun, CountsEnergyAtTimeZero) {
    Scene scene = one_disk(2.0, true);
    scene.grains.vx[0] = 3.0;
    const FallingEngine engine(scene);
    const RunInfo info = describe_run(scene, engine, 1e-3, 1.0);
    const double mass = 2000.0 * 3.14159265358979 * 1e-4;
    EXPECT_NEAR(info.initial.translational, 0.5 * mass * 9.0, 1e-12);
    EXPECT_NEAR(info.initial.potential, mass * 9.81 * 2.0, 1e-12);
    EXPECT_DOUBLE_EQ(info.lowest, -0.01);
    EXPECT_EQ(info.engine, "falling");
}

TEST(TimeStep, IsTheGivenOneOrTheSuggestionTimesTheFactor) {
    const Scene scene = one_disk(1.0, false);
    const FallingEngine engine(scene, 4e-3);
    RunSettings settings;
    EXPECT_DOUBLE_EQ(choose_time_step(settings, engine).dt, 4e-3);
    settings.time_step_factor = 0.25;
    EXPECT_DOUBLE_EQ(choose_time_step(settings, engine).dt, 1e-3);
    EXPECT_THAT(choose_time_step(settings, engine).origin, HasSubstr("0.25"));
    settings.time_step = 5e-3;
    EXPECT_DOUBLE_EQ(choose_time_step(settings, engine).dt, 5e-3);
    EXPECT_TRUE(choose_time_step(settings, engine).too_large());
}

TEST(TimeStep, CriticalOfASceneAtRestIsRefusedWithTheRemedy) {
    const Scene scene = one_disk(1.0, false);
    const FallingEngine engine(scene, std::numeric_limits<double>::infinity());
    RunSettings settings;
    try {
        choose_time_step(settings, engine);
        FAIL() << "an infinite step was accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("run.time_step in seconds"));
    }
    settings.time_step = 1e-3;
    EXPECT_DOUBLE_EQ(choose_time_step(settings, engine).dt, 1e-3);
}

TEST(StepCount, IsTheLeastThatReachesTheDuration) {
    EXPECT_EQ(step_count(1.0, 0.1), 10);
    EXPECT_EQ(step_count(1.0, 0.3), 4);
    EXPECT_EQ(step_count(0.3, 1e-4), 3000);
    EXPECT_EQ(step_count(1000.0, 1e-5), 100'000'000);
    EXPECT_EQ(step_count(1e-9, 1.0), 0) << "a millionth of a step is round-off";
    EXPECT_THROW(step_count(1.0, 1e-300), InputError);
}

}  // namespace
}  // namespace polargrain
