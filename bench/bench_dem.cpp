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

constexpr double k_radius = 0.01;
constexpr int k_columns = 20;
constexpr int k_rows = 25;
constexpr double k_step = 1e-4;  ///< [s]

/// A scene for beds `tiles` times as wide as a tile.
Scene empty_bed(double pitch, int tiles) {
    Scene scene = testing::empty_scene(0.5, 0.3);
    testing::add_box(scene, tiles * (k_columns + 0.6) * pitch, 3.0 * k_rows * pitch);
    return scene;
}

ShapeIndex add_grain_shape(Scene& scene, bool hexagons) {
    if (!hexagons) return testing::add_disk(scene, k_radius);
    std::vector<Vec2> corners;
    for (int k = 0; k < 6; ++k) {
        const auto [sine, cosine] = sine_cosine(k_pi / 3.0 * k);
        corners.emplace_back(k_radius * cosine, k_radius * sine);
    }
    return scene.add(std::make_shared<const Shape>(prepare_outline("hexagon", corners)));
}

double pitch_of(bool hexagons) { return (hexagons ? 1.86 : 2.02) * k_radius; }

/// Grains between walls, in rows that are shaken a little out of place, after they have come to rest.
Scene settled_tile(bool hexagons, const DemSettings& settings) {
    const double pitch = pitch_of(hexagons);
    Scene scene = empty_bed(pitch, 1);
    const ShapeIndex shape = add_grain_shape(scene, hexagons);
    RandomStream random(1, RandomPurpose::test);
    for (int row = 0; row < k_rows; ++row) {
        for (int column = 0; column < k_columns; ++column) {
            const double x = (column + 0.55 + 0.5 * (row % 2) + random.uniform(-0.03, 0.03)) * pitch;
            const double y = (0.6 + 0.95 * row) * pitch;
            scene.add(Grain{shape, 0, {x, y}, hexagons ? random.uniform(-3.0, 3.0) : 0.0});
        }
    }
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    for (double time = 0.0; time < 0.5; time += k_step) engine->step(world, k_step, report);
    scene.grains = world.grains;
    return scene;
}

/// A bed at rest, as deep at all widths: tiles side by side, every other one in the mirror, so that all sizes have the
/// same contacts per grain, load and overlap. Grains are numbered row by row over the whole width, as they are poured.
Scene bed(bool hexagons, int n, const DemSettings& settings) {
    const Grains grains = settled_tile(hexagons, settings).grains;
    const int tiles = n / (k_columns * k_rows);
    const double pitch = pitch_of(hexagons);
    Scene scene = empty_bed(pitch, tiles);
    const ShapeIndex shape = add_grain_shape(scene, hexagons);
    const double width = (k_columns + 0.6) * pitch;
    for (int row = 0; row < k_rows; ++row) {
        for (int column = 0; column < tiles * k_columns; ++column) {
            const int number = column / k_columns;
            const bool mirror = number % 2 == 1;
            const int within = column % k_columns;
            const GrainIndex of_tile = row * k_columns + (mirror ? k_columns - 1 - within : within);
            const Vec2 place = grains.position(of_tile);
            const double angle = grains.angle[Grains::at(of_tile)];
            scene.add(Grain{shape,
                            0,
                            {number * width + (mirror ? width - place.x() : place.x()), place.y()},
                            mirror ? -angle : angle});
        }
    }
    return scene;
}

/// Rate of grain-steps: the small steps that the engine takes inside one of the run's. Measured over the same time of
/// the bed's life at all sizes, again and again.
void dem_steps(benchmark::State& state, bool hexagons) {
    DemSettings settings;
    settings.target_overlap = 0.05;
    const Scene scene = bed(hexagons, static_cast<int>(state.range(0)), settings);
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < 50; ++k) engine->step(world, k_step, report);
    const World start = world;
    Checkpoint memory;
    engine->save(memory);
    const int steps = 20;
    double contacts = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        state.PauseTiming();
        world = start;
        engine->load(memory);
        state.ResumeTiming();
        for (int k = 0; k < steps; ++k) {
            engine->step(world, k_step, report);
            contacts += static_cast<double>(report.contacts.size());
        }
    }
    const double grains = static_cast<double>(scene.grains.size());
    const double taken = steps * static_cast<double>(state.iterations());
    state.counters["grain_steps_per_second"] =
        benchmark::Counter(grains * engine->parts_of_step(k_step) * taken, benchmark::Counter::kIsRate);
    state.counters["contacts_per_grain"] = contacts / (grains * taken);
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
