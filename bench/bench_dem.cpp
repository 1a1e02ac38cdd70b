#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "shapes/outline.h"
#include "src/core/elementary.h"
#include "src/core/random.h"
#include "src/engines/dem/dem_engine.h"
#include "src/engines/dem/pair_search.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

/// A bed of equal grains on a hexagonal lattice, tight enough that neighbours touch: beds of all sizes have the same
/// number of contacts per grain.
Scene bed(bool hexagons, int n) {
    Scene scene = testing::empty_scene(0.5, 0.3);
    const double radius = 0.01;
    std::vector<Vec2> corners;
    for (int k = 0; k < 6; ++k) {
        const auto [sine, cosine] = sine_cosine(k_pi / 3.0 * k);
        corners.emplace_back(radius * cosine, radius * sine);
    }
    const ShapeIndex shape = hexagons ? scene.add(std::make_shared<const Shape>(prepare_outline("hexagon", corners)))
                                      : testing::add_disk(scene, radius);
    const int columns = static_cast<int>(std::sqrt(n));
    const double pitch = (hexagons ? 1.82 : 1.995) * radius;
    testing::add_box(scene, (columns + 0.6) * pitch, 3.0 * n / columns * pitch);
    RandomStream random(1, RandomPurpose::test);
    for (int k = 0; k < n; ++k) {
        const int row = k / columns;
        const double shift = row % 2 == 0 ? 0.0 : 0.5;
        scene.add(Grain{shape,
                        0,
                        {(k % columns + 0.55 + shift) * pitch, (0.52 + 0.8661 * row) * pitch},
                        hexagons ? random.uniform(-3.0, 3.0) : 0.0});
    }
    return scene;
}

/// Rate of grain-steps: the small steps that the engine takes inside one of the run's.
void dem_steps(benchmark::State& state, bool hexagons) {
    const Scene scene = bed(hexagons, static_cast<int>(state.range(0)));
    DemSettings settings;
    settings.target_overlap = 0.05;
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    const double dt = 1e-4;
    for (int k = 0; k < 50; ++k) engine->step(world, dt, report);
    for ([[maybe_unused]] auto _ : state) engine->step(world, dt, report);
    const double grains = static_cast<double>(scene.grains.size());
    const double steps = engine->parts_of_step(dt) * static_cast<double>(state.iterations());
    state.counters["grain_steps_per_second"] = benchmark::Counter(grains * steps, benchmark::Counter::kIsRate);
    state.counters["contacts_per_grain"] = static_cast<double>(report.contacts.size()) / grains;
}

void numbers_of_grains(benchmark::internal::Benchmark* bench) {
    for (const int n : {500, 1000, 4000, 16000, 32000}) bench->Arg(n);
    bench->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(dem_steps, disks, false)->Apply(numbers_of_grains);
BENCHMARK_CAPTURE(dem_steps, hexagons, true)->Apply(numbers_of_grains);

/// Circles at an area fraction of 0.5 whose radii spread over 1 : ratio.
std::vector<BoundingCircle> spread_circles(int n, double ratio) {
    RandomStream random(2, RandomPurpose::test);
    std::vector<BoundingCircle> circles;
    double area = 0.0;
    for (int k = 0; k < n; ++k) {
        const double radius = exponential(natural_log(ratio) * random.uniform());
        circles.push_back({Vec2::Zero(), radius});
        area += k_pi * radius * radius;
    }
    const double side = std::sqrt(area / 0.5);
    for (BoundingCircle& c : circles) c.centre = {random.uniform(0.0, side), random.uniform(0.0, side)};
    return circles;
}

void dem_pair_search(benchmark::State& state, PairSearch search, double ratio) {
    const auto circles = spread_circles(static_cast<int>(state.range(0)), ratio);
    PairFinder finder(search);
    std::vector<GrainPair> pairs;
    for ([[maybe_unused]] auto _ : state) finder.find_pairs(circles, pairs);
    state.SetComplexityN(state.range(0));
}

void sizes(benchmark::internal::Benchmark* bench) { bench->RangeMultiplier(4)->Range(500, 8000)->Complexity(); }

BENCHMARK_CAPTURE(dem_pair_search, direct_1_to_100, PairSearch::direct, 100.0)->Apply(sizes);
BENCHMARK_CAPTURE(dem_pair_search, verlet_1_to_100, PairSearch::verlet, 100.0)->Apply(sizes);
BENCHMARK_CAPTURE(dem_pair_search, nbs_equal, PairSearch::nbs, 1.0)->Apply(sizes);
BENCHMARK_CAPTURE(dem_pair_search, nbs_1_to_100, PairSearch::nbs, 100.0)->Apply(sizes);
BENCHMARK_CAPTURE(dem_pair_search, cgrid_1_to_100, PairSearch::cgrid, 100.0)->Apply(sizes);

}  // namespace
}  // namespace polargrain
