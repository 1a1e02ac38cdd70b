#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "src/core/error.h"
#include "src/run/settle.h"
#include "src/run/simulation.h"
#include "tests/run/falling_engine.h"

namespace polargrain {
namespace {

/// Sums what it is shown, as meters do, and remembers each sample.
class SummingSink : public Sink {
public:
    explicit SummingSink(double every) : every_(every) {}
    double every() const override { return every_; }
    void begin(const Scene&, const RunInfo&) override {}
    void save(Checkpoint& checkpoint) override { checkpoint.put("sum", std::vector{sum_}); }
    void resume(const Scene&, const RunInfo&, const Checkpoint& saved) override { sum_ = saved.reals("sum").at(0); }
    void step(const World& world, double, const StepReport& report) override {
        sum_ += world.grains.y[0] + report.deepest;
    }
    void sample(const Sample& sample) override {
        samples.push_back({static_cast<double>(sample.world.step), sum_, sample.totals.ledger.friction_loss,
                           static_cast<double>(sample.report.contacts.size())});
    }

    std::vector<std::vector<double>> samples;

private:
    double every_;
    double sum_ = 0.0;
};

struct Result {
    std::string hash;
    std::vector<std::vector<double>> samples;
    std::vector<Checkpoint> checkpoints;
    Totals totals;
    std::int64_t steps_by_engine = 0;
};

constexpr double k_every_step = 1e-9;  // [s] of wall clock: always due

Result simulate(const Scene& scene, double duration, const Checkpoint* saved) {
    Result result;
    FallingEngine engine(scene);
    SummingSink often(0.003), ends(0.0);
    RunInfo info;
    info.dt = 1e-3;
    info.duration = duration;
    Simulation simulation(scene, engine, info);
    simulation.add(often);
    simulation.add(ends);
    const LoopControl control{.keep = [&](const Checkpoint& kept) { result.checkpoints.push_back(kept); },
                              .keep_every = k_every_step};
    if (saved != nullptr) {
        simulation.resume(*saved, control);
    } else {
        simulation.run(control);
    }
    result.hash = state_hash(simulation.state().world);
    result.samples = often.samples;
    result.samples.insert(result.samples.end(), ends.samples.begin(), ends.samples.end());
    result.totals = simulation.state().totals;
    result.steps_by_engine = engine.steps_taken();
    return result;
}

/// The last samples are those that a run from the checkpoint still had to take.
void expect_tail(const std::vector<std::vector<double>>& whole, const std::vector<std::vector<double>>& tail,
                 std::int64_t step) {
    std::vector<std::vector<double>> later;
    for (const auto& sample : whole) {
        if (sample[0] > static_cast<double>(step)) later.push_back(sample);
    }
    EXPECT_EQ(tail, later);
}

TEST(Resume, FromAnyStepGivesWhatTheUninterruptedRunGives) {
    const Scene scene = one_disk(0.005, true);
    const Result whole = simulate(scene, 0.05, nullptr);
    ASSERT_EQ(whole.checkpoints.size(), 52U)
        << "before the first step, after each of fifty, and before the last sample";
    for (std::size_t k = 0; k < 50; ++k) {
        const Result resumed = simulate(scene, 0.05, &whole.checkpoints[k]);
        EXPECT_EQ(resumed.hash, whole.hash);
        EXPECT_EQ(resumed.steps_by_engine, 50) << "the engine's own memory came along";
        EXPECT_EQ(resumed.totals.ledger.friction_loss, whole.totals.ledger.friction_loss);
        EXPECT_EQ(resumed.totals.contact_sum, whole.totals.contact_sum);
        EXPECT_EQ(resumed.totals.deepest, whole.totals.deepest);
        expect_tail(whole.samples, resumed.samples, static_cast<std::int64_t>(k));
    }
}

TEST(Resume, AFinishedRunGoesOnAsIfItHadNeverEnded) {
    const Scene scene = one_disk(0.005, true);
    const Result whole = simulate(scene, 0.05, nullptr);
    const Result shorter = simulate(scene, 0.0205, nullptr);
    const Result resumed = simulate(scene, 0.05, &shorter.checkpoints.back());
    EXPECT_EQ(resumed.hash, whole.hash);
    expect_tail(whole.samples, resumed.samples, 21);
}

TEST(Resume, OfAFinishedRunTakesItsLastSampleAgainAndNoStep) {
    const Scene scene = one_disk(0.005, true);
    const Result whole = simulate(scene, 0.05, nullptr);
    const Result again = simulate(scene, 0.05, &whole.checkpoints.back());
    EXPECT_EQ(again.steps_by_engine, 50);
    EXPECT_EQ(again.samples.back(), whole.samples.back()) << "with the contacts of the last step";
    EXPECT_EQ(again.samples.back()[3], 1.0);
}

TEST(Resume, WantsACheckpointOfTheSameRun) {
    const Scene scene = one_disk(0.005, true);
    const Result whole = simulate(scene, 0.01, nullptr);
    Scene two = scene;
    two.add(Grain{.position = {0.1, 1.0}});
    EXPECT_THROW(simulate(two, 0.01, &whole.checkpoints[3]), RunError);
    EXPECT_THROW(simulate(scene, 0.01, std::make_unique<Checkpoint>().get()), RunError);
}

TEST(ResumeSettling, FromAnyStepComesToRestAlike) {
    const Scene scene = one_disk(0.003, true);
    const EngineFactory make = [](const Scene& still) { return std::make_unique<FallingEngine>(still); };
    std::vector<Checkpoint> checkpoints;
    const LoopControl keeping{.keep = [&](const Checkpoint& kept) { checkpoints.push_back(kept); },
                              .keep_every = k_every_step};
    const Settled whole = settle(scene, {.until_energy = 1e-6, .at_most = 1.0}, 1e-3, make, keeping);
    ASSERT_TRUE(whole.at_rest);
    ASSERT_GT(checkpoints.size(), 20U);
    for (const Checkpoint& saved : checkpoints) {
        const Settled resumed = settle(scene, {.until_energy = 1e-6, .at_most = 1.0}, 1e-3, make, {}, &saved);
        EXPECT_EQ(resumed.time, whole.time);
        EXPECT_EQ(resumed.grains.y, whole.grains.y);
        EXPECT_EQ(resumed.engine.integers("steps_taken"), whole.engine.integers("steps_taken"));
    }
}

TEST(ResumeSettling, AStopKeepsACheckpointAndSaysSo) {
    const Scene scene = one_disk(0.003, true);
    const EngineFactory make = [](const Scene& still) { return std::make_unique<FallingEngine>(still); };
    const std::atomic<bool> stop = true;
    int kept = 0;
    const Settled stopped = settle(scene, {}, 1e-3, make, {.stop = &stop, .keep = [&](const Checkpoint&) { ++kept; }});
    EXPECT_TRUE(stopped.stopped);
    EXPECT_FALSE(stopped.at_rest);
    EXPECT_EQ(kept, 2);
}

}  // namespace
}  // namespace polargrain
