#include <benchmark/benchmark.h>

#include <memory>

#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/contact_engine.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using MakeEngine = std::unique_ptr<Engine> (*)(const Scene&);

/// Steps of a pour at 1 kHz, from the state after `warm_up` steps: 0 all falling, 150 to 250 collapsing, 600 and 800 a
/// bed.
void step(benchmark::State& state, MakeEngine make, testing::PourShape shape) {
    const Scene scene = testing::pour(shape, static_cast<int>(state.range(0)), 1, 0.3, 0.2);
    const auto engine = make(scene);
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
    state.counters["s_per_grain_step"] =
        benchmark::Counter(grains, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["rejected"] = static_cast<double>(moves.rejected) / static_cast<double>(moves.tried);
    state.counters["impacts_per_grain_step"] =
        static_cast<double>(impacts) / (grains * static_cast<double>(state.iterations()));
}

void phases(benchmark::internal::Benchmark* bench) {
    for (const int grains : {500, 2000}) {
        for (const int warm_up : {0, 150, 250, 600, 800}) bench->Args({grains, warm_up});
    }
    bench->ArgNames({"grains", "warm_up"})->Iterations(100)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(step, literal_rough, make_contact_1994, testing::PourShape::rough)->Apply(phases);
BENCHMARK_CAPTURE(step, refined_rough, make_contact, testing::PourShape::rough)->Apply(phases);
BENCHMARK_CAPTURE(step, refined_disk, make_contact, testing::PourShape::disk)->Apply(phases);

}  // namespace
}  // namespace polargrain
