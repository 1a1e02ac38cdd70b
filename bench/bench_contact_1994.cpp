#include <benchmark/benchmark.h>

#include <memory>

#include "src/engines/contact/contact_1994.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

/// A pour of rough 24-gons at 1 kHz, from the state after `warm_up` steps: 0 all falling, 150 collapsing, 600 a bed.
void literal_step(benchmark::State& state) {
    const Scene scene = testing::pour(testing::PourShape::rough, static_cast<int>(state.range(0)), 1, 0.3, 0.2);
    const auto engine = make_contact_1994(scene);
    World world = initial_world(scene);
    StepReport report;
    for (std::int64_t k = 0; k < state.range(1); ++k) engine->step(world, 1e-3, report);
    MoveCount moves;
    std::int64_t impacts = 0;
    for ([[maybe_unused]] auto _ : state) {
        engine->step(world, 1e-3, report);
        moves += report.moves;
        impacts += report.impacts;
    }
    const auto grains = static_cast<double>(scene.grains.size());
    state.counters["ns_per_grain_step"] =
        benchmark::Counter(grains * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["rejected"] = static_cast<double>(moves.rejected) / static_cast<double>(moves.tried);
    state.counters["impacts_per_grain_step"] =
        static_cast<double>(impacts) / (grains * static_cast<double>(state.iterations()));
}

BENCHMARK(literal_step)
    ->ArgNames({"grains", "warm_up"})
    ->Args({500, 0})
    ->Args({500, 150})
    ->Args({500, 600})
    ->Args({2000, 150})
    ->Args({2000, 600})
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace polargrain

BENCHMARK_MAIN();
