#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "src/engines/contact/contact_engine.h"
#include "src/engines/contact/energy_guard.h"
#include "src/engines/contact/gap_detection.h"
#include "src/engines/contact/gap_solver.h"
#include "src/engines/contact/position_correction.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

constexpr double k_dt = 1e-3;

/// A pour of rough grains after some steps of the refined engine, with the stages of its next step at hand.
class Stages {
public:
    Stages(int grains, int warm_up)
        : scene_(testing::pour(testing::PourShape::rough, grains, 1, 0.3, 0.2)),
          detection_(scene_),
          solver_(scene_),
          correction_(scene_) {
        const auto engine = make_contact(scene_);
        World world = initial_world(scene_);
        StepReport report;
        for (int k = 0; k < warm_up; ++k) engine->step(world, k_dt, report);
        const auto n = static_cast<std::size_t>(scene_.grains.size());
        poses_.resize(n);
        for (std::size_t k = 0; k < n; ++k) {
            const auto g = static_cast<GrainIndex>(k);
            bodies_.push_back({world.grains.velocity(g), world.grains.spin[k], 1.0 / world.grains.mass[k],
                               1.0 / world.grains.inertia[k], false});
            poses_.centre[k] = world.grains.position(g);
            poses_.angle[k] = world.grains.angle[k];
            poses_.refresh(k);
        }
        time_ = world.time;
        detection_.detect(poses_, poses_, bodies_, time_, time_, k_dt);
        // Impulses of a step already taken are what the next one starts from.
        std::vector<SolverBody> bodies = bodies_;
        PoseSet trial = poses_;
        std::vector<PairContacts> pairs;
        contacts_.clear();
        detection_.hand_over(pairs, contacts_);
        detection_.begin_clean();
        report_.clear(scene_.walls.size());
        solver_.advance(contacts_, bodies, poses_, trial, 0, time_, k_dt, GapSolver::k_usual, report_);
        for (std::size_t k = 0; k < n; ++k) trial.refresh(k);
        next_poses_ = trial;
    }

    /// To and fro between the poses at the two ends of a step: what has not moved is not looked at again.
    void detect() {
        detection_.detect(poses_, forth_ ? next_poses_ : poses_, bodies_, time_, time_ + k_dt, k_dt);
        forth_ = !forth_;
    }

    /// With the copies of the state that the engine takes before a step, too.
    void solve() {
        std::vector<GapContact> contacts = contacts_;
        std::vector<SolverBody> bodies = bodies_;
        PoseSet trial = poses_;
        report_.clear(scene_.walls.size());
        solver_.advance(contacts, bodies, poses_, trial, 0, time_, k_dt, GapSolver::k_usual, report_);
    }

    void correct() {
        PoseSet trial = poses_;
        correction_.correct(contacts_, bodies_, scene_.gravity, {k_dt, PositionCorrection::k_trigger}, 1.0,
                            solver_.lanes(), trial);
    }

    double sum_energy() const { return total_energy(bodies_, poses_, scene_.gravity, Parallel(1)); }

    double grains() const { return static_cast<double>(scene_.grains.size()); }
    double contacts() const { return static_cast<double>(contacts_.size()); }

private:
    Scene scene_;
    GapDetection detection_;
    GapSolver solver_;
    PositionCorrection correction_;
    std::vector<SolverBody> bodies_;
    PoseSet poses_, next_poses_;
    bool forth_ = true;  ///< the next detection is at next_poses_
    std::vector<GapContact> contacts_;
    StepReport report_;
    double time_ = 0.0;
};

template <typename Stage>
void stage(benchmark::State& state, Stage run) {
    Stages stages(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    for ([[maybe_unused]] auto _ : state) run(stages);
    state.counters["s_per_grain"] = benchmark::Counter(
        stages.grains(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["contacts_per_grain"] = stages.contacts() / stages.grains();
}

/// 0 falling, 250 collapsing, 800 a bed; as for whole steps.
void phases(benchmark::internal::Benchmark* bench) {
    for (const int warm_up : {0, 250, 800}) bench->Args({500, warm_up});
    bench->ArgNames({"grains", "warm_up"})->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(stage, detection, [](Stages& s) { s.detect(); })->Apply(phases);
BENCHMARK_CAPTURE(stage, sub_steps, [](Stages& s) { s.solve(); })->Apply(phases);
BENCHMARK_CAPTURE(stage, position_correction, [](Stages& s) { s.correct(); })->Apply(phases);
BENCHMARK_CAPTURE(stage, energy_sum, [](Stages& s) { benchmark::DoNotOptimize(s.sum_energy()); })->Apply(phases);

}  // namespace
}  // namespace polargrain
