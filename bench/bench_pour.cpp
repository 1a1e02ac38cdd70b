#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "src/core/error.h"
#include "src/detect/contact_finder.h"
#include "src/detect/neighbours.h"
#include "src/engines/box2d/box2d_engine.h"
#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/contact_engine.h"
#include "src/engines/dem/dem_engine.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

// Whole pours, from rows in the air to a bed at rest, with every engine. A pour of n grains has a box of 20 grain
// diameters for 500 and of the same proportions for others, so that all sizes look alike and only times get longer.

constexpr double k_d = 0.02;   // [m]
constexpr double k_dt = 1e-3;  // [s]

using MakeEngine = std::unique_ptr<Engine> (*)(const Scene&);

std::unique_ptr<Engine> make_soft(const Scene& scene) { return make_dem(scene, {}); }
std::unique_ptr<Engine> make_games(const Scene& scene) { return make_box2d(scene); }

/// Processor time of all threads of this program [s].
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A line of /proc/self/status such as VmHWM, in bytes.
double memory(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kilobytes = 0.0;
        if (word == key + ":" && status >> kilobytes) return 1024.0 * kilobytes;
    }
    return std::nan("");
}

/// Depths of the pairs of grains that overlap, whatever the engine says of them [m].
std::vector<double> overlaps(const Scene& scene, const Grains& grains) {
    std::vector<BoundingCircle> circles;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        circles.push_back({grains.position(k), outer_radius(scene.shape_of(k))});
    }
    NeighbourSearch search;
    std::vector<GrainPair> pairs;
    search.find_pairs(circles, pairs);
    std::vector<double> depths;
    for (const auto& [a, b] : pairs) {
        const Pose pose_a = grains.pose(a);
        const Pose pose_b = grains.pose(b);
        const auto contact = find_contact({scene.shape_of(a), pose_a, {}}, {scene.shape_of(b), pose_b, {}});
        if (contact) depths.push_back(contact->depth);
    }
    return depths;
}

/// Until the highest grain would have fallen half its time, until it lies and the bed has come down, and as long at
/// rest.
struct Phase {
    const char* name;
    double until;  ///< in times that the highest grain needs to fall to the floor
};
constexpr std::array k_phases{Phase{"fall", 0.5}, Phase{"collapse", 1.5}, Phase{"rest", 2.5}};

void pour(benchmark::State& state, MakeEngine make, testing::PourShape shape) {
    const auto grains = static_cast<int>(state.range(0));
    const int columns = static_cast<int>(std::lround(20.0 * std::sqrt(grains / 500.0)));
    const double memory_before = memory("VmRSS");
    Scene scene = testing::pour(shape, grains, 1, 0.3, 0.2, columns);
    scene.threads = static_cast<int>(state.range(1));
    const double top = *std::max_element(scene.grains.y.begin(), scene.grains.y.end());
    const double fall_time = std::sqrt(2.0 * top / 9.81);
    MoveCount moves;
    double deepest = 0.0;
    StepReport report;
    double dt = k_dt;
    try {
        auto engine = make(scene);
        World world = initial_world(scene);
        // The first step is not counted: engines make their preparations in it. Box2D refuses steps in which grains may
        // go farther than it can count.
        try {
            engine->step(world, dt, report);
        } catch (const InputError&) {
            dt *= 0.5;
            engine = make(scene);
            world = initial_world(scene);
            engine->step(world, dt, report);
        }
        for ([[maybe_unused]] auto _ : state) {
            const double start = processor_seconds();
            const double begin = world.time;
            for (const Phase& phase : k_phases) {
                const double phase_start = processor_seconds();
                const double from = world.time;
                while (world.time < phase.until * fall_time) {
                    engine->step(world, dt, report);
                    moves += report.moves;
                    deepest = std::max(deepest, report.deepest);
                }
                state.counters[phase.name] = (processor_seconds() - phase_start) / (world.time - from);
            }
            state.counters["whole"] = (processor_seconds() - start) / (world.time - begin);
            state.counters["simulated"] = world.time - begin;
        }
        const std::vector<double> depths = overlaps(scene, world.grains);
        double sum = 0.0;
        for (const double depth : depths) {
            sum += depth;
            deepest = std::max(deepest, depth);
        }
        state.counters["overlap"] = depths.empty() ? 0.0 : sum / k_d / static_cast<double>(depths.size());
    } catch (const std::exception& error) {
        state.SkipWithError(error.what());
        return;
    }
    state.counters["step"] = dt;
    state.counters["rejected"] = static_cast<double>(moves.rejected) / static_cast<double>(moves.tried);
    state.counters["deepest"] = deepest / k_d;
    state.counters["bytes"] = (memory("VmHWM") - memory_before) / grains;
}

void sizes(benchmark::internal::Benchmark* bench) {
    for (const int grains : {125, 500, 2000, 8000}) {
        for (const int workers : {1, 2}) bench->Args({grains, workers});
    }
    bench->ArgNames({"grains", "workers"})->Iterations(1)->Unit(benchmark::kSecond)->MeasureProcessCPUTime();
}

using testing::PourShape;
BENCHMARK_CAPTURE(pour, contact_rough, make_contact, PourShape::rough)->Apply(sizes);
BENCHMARK_CAPTURE(pour, contact_1994_rough, make_contact_1994, PourShape::rough)->Apply(sizes);
BENCHMARK_CAPTURE(pour, dem_rough, make_soft, PourShape::rough)->Apply(sizes);
BENCHMARK_CAPTURE(pour, box2d_rough, make_games, PourShape::rough)->Apply(sizes);
BENCHMARK_CAPTURE(pour, contact_disks, make_contact, PourShape::disk)->Apply(sizes);
BENCHMARK_CAPTURE(pour, contact_1994_disks, make_contact_1994, PourShape::disk)->Apply(sizes);
BENCHMARK_CAPTURE(pour, dem_disks, make_soft, PourShape::disk)->Apply(sizes);
BENCHMARK_CAPTURE(pour, box2d_disks, make_games, PourShape::disk)->Apply(sizes);

}  // namespace
}  // namespace polargrain
