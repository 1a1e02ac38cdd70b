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
constexpr double k_shake = 0.002;  ///< of a radius

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
    const double dt = engine->suggested_dt();
    while (world.time < 0.5) engine->step(world, dt, report);
    scene.grains = world.grains;
    return scene;
}

/// How the grains of a bed are numbered.
enum class Numbers : std::uint8_t {
    by_rows,  ///< over the whole width, as they are poured
    mixed,    ///< at random, as after a long time in a mixer
};

/// A bed at rest, as deep at all widths: tiles side by side, every other one in the mirror, so that all sizes have the
/// same contacts per grain, load and overlap. Each grain is shaken a little out of place again, so that no tile is like
/// another: a processor would learn where its branches go.
Scene bed(bool hexagons, Numbers numbers, int n, const DemSettings& settings) {
    const Grains grains = settled_tile(hexagons, settings).grains;
    const int tiles = n / (k_columns * k_rows);
    const double pitch = pitch_of(hexagons);
    Scene scene = empty_bed(pitch, tiles);
    const ShapeIndex shape = add_grain_shape(scene, hexagons);
    const double width = (k_columns + 0.6) * pitch;
    RandomStream random(2, RandomPurpose::test);
    std::vector<Grain> placed;
    for (int row = 0; row < k_rows; ++row) {
        for (int column = 0; column < tiles * k_columns; ++column) {
            const int number = column / k_columns;
            const bool mirror = number % 2 == 1;
            const int within = column % k_columns;
            const GrainIndex of_tile = row * k_columns + (mirror ? k_columns - 1 - within : within);
            const Vec2 place = grains.position(of_tile) +
                               k_shake * k_radius * Vec2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
            const double angle = grains.angle[Grains::at(of_tile)];
            placed.push_back({shape,
                              0,
                              {number * width + (mirror ? width - place.x() : place.x()), place.y()},
                              mirror ? -angle : angle});
        }
    }
    for (std::size_t k = placed.size(); numbers == Numbers::mixed && k > 1; --k) {
        std::swap(placed[k - 1], placed[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    }
    for (const Grain& grain : placed) scene.add(grain);
    return scene;
}

/// Rate of grain-steps: the small steps that the engine takes inside one of the run's. Measured over the same time of
/// the bed's life at all sizes, again and again.
void dem_steps(benchmark::State& state, bool hexagons, Numbers numbers) {
    DemSettings settings;
    settings.target_overlap = 0.05;
    const Scene scene = bed(hexagons, numbers, static_cast<int>(state.range(0)), settings);
    const auto engine = make_dem(scene, settings);
    World world = initial_world(scene);
    StepReport report;
    const double dt = engine->suggested_dt();
    for (int k = 0; k < 10; ++k) engine->step(world, dt, report);
    const World start = world;
    Checkpoint memory;
    engine->save(memory);
    const int steps = 2;
    double contacts = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        state.PauseTiming();
        world = start;
        engine->load(memory);
        state.ResumeTiming();
        for (int k = 0; k < steps; ++k) {
            engine->step(world, dt, report);
            contacts += static_cast<double>(report.contacts.size());
        }
    }
    const double grains = static_cast<double>(scene.grains.size());
    const double taken = steps * static_cast<double>(state.iterations());
    state.counters["grain_steps_per_second"] =
        benchmark::Counter(grains * engine->parts_of_step(dt) * taken, benchmark::Counter::kIsRate);
    state.counters["contacts_per_grain"] = contacts / (grains * taken);
}

void numbers_of_grains(benchmark::internal::Benchmark* bench) {
    for (const int n : {500, 1000, 4000, 16000, 32000}) bench->Arg(n);
    bench->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(dem_steps, disks, false, Numbers::by_rows)->Apply(numbers_of_grains)->Arg(128000);
BENCHMARK_CAPTURE(dem_steps, mixed_disks, false, Numbers::mixed)->Apply(numbers_of_grains);
BENCHMARK_CAPTURE(dem_steps, hexagons, true, Numbers::by_rows)->Apply(numbers_of_grains);

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
