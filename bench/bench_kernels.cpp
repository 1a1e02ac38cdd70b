#include <benchmark/benchmark.h>

#include <vector>

#include "src/detect/gap_points.h"
#include "src/detect/neighbours.h"
#include "src/engines/contact/impact_law.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

/// Two rough 24-gons side by side, `percent` of a diameter between their centres.
struct NearPair {
    Scene scene = testing::empty_scene(0.3, 0.2);
    Pose first = Pose::at({0.0, 0.0}, 0.3);
    Pose second;

    explicit NearPair(std::int64_t percent) : second(Pose::at({2e-4 * static_cast<double>(percent), 0.0}, 1.1)) {
        testing::add_rough(scene, 0.01, 0.2, 1);
        testing::add_rough(scene, 0.01, 0.2, 2);
    }
};

void overlap_test(benchmark::State& state) {
    const NearPair pair(state.range(0));
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(overlap(pair.scene.shape(0), pair.first, pair.scene.shape(1), pair.second));
    }
}
BENCHMARK(overlap_test)->ArgName("percent")->Arg(95)->Arg(100)->Arg(105)->Arg(120);

void gap_points(benchmark::State& state) {
    const NearPair pair(state.range(0));
    const GapRules rules{5e-4, 2e-5};
    std::vector<GapPoint> points;
    for ([[maybe_unused]] auto _ : state) {
        points.clear();
        find_gap_points(pair.scene.shape(1), pair.second, pair.scene.shape(0), pair.first, rules, points);
        benchmark::DoNotOptimize(points.data());
    }
}
BENCHMARK(gap_points)->ArgName("percent")->Arg(95)->Arg(100)->Arg(105)->Arg(120);

void neighbour_search(benchmark::State& state) {
    const Scene scene = testing::pour(testing::PourShape::disk, static_cast<int>(state.range(0)), 1, 0.3, 0.2, 40);
    std::vector<BoundingCircle> circles;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) circles.push_back({scene.grains.position(k), 0.0125});
    NeighbourSearch search;
    std::vector<GrainPair> pairs;
    for ([[maybe_unused]] auto _ : state) search.find_pairs(circles, pairs);
    state.SetComplexityN(state.range(0));
}
BENCHMARK(neighbour_search)->RangeMultiplier(4)->Range(500, 32000)->Complexity(benchmark::oN);

void impact(benchmark::State& state) {
    const ContactFrame frame =
        contact_frame({0.0, 1.0}, {0.003, -0.01}, {1.0, 1e4}, {-0.002, 0.01}, ImpactBody{1.2, 1.1e4});
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(solve_impact(frame, RelativeVelocity{0.4, -1.0}, 0.2, 0.3));
    }
}
BENCHMARK(impact);

}  // namespace
}  // namespace polargrain
