#include "src/reproduce/efficiency_scenes.h"

#include <fmt/format.h>

#include "src/reproduce/dominoes.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {

namespace {

constexpr const char* k_bin = R"(title = "Rough grains through a wide opening, {engine}, {label}"
source = "Hogue & Newland 1994, sections 4.3.1 and 4.4"

[run]
engine = "{engine}"
duration = 0.75
time_step_factor = {factor}
seed = {seed}

[materials.stone]
density = 2500.0
restitution = 0.3
friction = 0.2

[shapes.grain]
type = "rough"
radius = 0.01
roughness = 0.1
vertices = 24

[[walls]]
name = "left"
material = "stone"
points = [[0.0, 0.6], [0.0, 0.0], [0.07, 0.0]]

[[walls]]
name = "right"
material = "stone"
points = [[0.23, 0.0], [0.3, 0.0], [0.3, 0.6]]

[[walls]]
name = "plug"
material = "stone"
points = [[0.07, 0.0], [0.23, 0.0]]
remove_at = 0.4

[[fill]]
count = 200
shapes = ["grain"]
material = "stone"
region = [[0.0, 0.0], [0.3, 0.5]]
size = {{ distribution = "uniform", min = 0.85, max = 1.15 }}

[output]
frames = {{ every = 0.0 }}
trajectory = {{ every = 0.0 }}
series = {{ every = 0.0 }}
{dem})";

std::string dem_table(const EfficiencyRun& run) {
    if (run.steps_per_contact == 0) return "";
    return fmt::format("\n[dem]\ntarget_overlap = {}\nresolution = {}\n", run.target_overlap, run.steps_per_contact);
}

/// A leaning first domino, each time a little steeper: the wave forgets it.
Piece dominoes(const std::string& engine, const EfficiencyRun& run, unsigned beginning) {
    DominoSetup setup{.kind = table_1().front(), .gap = 2.0, .table_friction = k_rough_table, .engine = engine};
    setup.count = 30;
    setup.lean = 1.0 - 0.05 * (beginning - 1.0);
    setup.time_step_factor = run.time_step_factor;
    setup.tables = dem_table(run);
    return domino_piece(setup);
}

Piece pouring(const std::string& engine, const EfficiencyRun& run, unsigned beginning) {
    std::vector<std::string> set{"run.duration=0.6", "run.time_step=\"critical\"",
                                 fmt::format("run.time_step_factor={}", run.time_step_factor),
                                 "output.trajectory.every=0.0", "output.series.every=0.0"};
    if (run.steps_per_contact > 0) {
        set.push_back(fmt::format("dem.target_overlap={}", run.target_overlap));
        set.push_back(fmt::format("dem.resolution={}", run.steps_per_contact));
    }
    Piece piece = shipped_piece("pour-500-disks", engine, beginning, set);
    piece.name += "-timed";
    return piece;
}

Piece bin(const std::string& engine, const EfficiencyRun& run, unsigned beginning) {
    using namespace fmt::literals;
    return {fmt::format("wide-bin-{}-seed{}", engine, beginning),
            fmt::format(fmt::runtime(k_bin), "engine"_a = engine, "label"_a = run.label,
                        "factor"_a = run.time_step_factor, "seed"_a = beginning, "dem"_a = dem_table(run)),
            engine};
}

std::vector<double> domino_factors(const std::string& engine) {
    // The literal method needs a fraction of its own limit here, see domino_piece.
    if (engine == "contact-1994") return {0.5, 0.25, 0.125, 0.0625, 0.03125};
    return {1.0, 0.5, 0.25, 0.125};
}

std::vector<double> bed_factors(const std::string& engine) {
    if (engine == "contact") return {2.0, 1.0, 0.5, 0.25, 0.125};
    return {1.0, 0.5, 0.25, 0.125};
}

}  // namespace

const std::vector<EfficiencyScene>& efficiency_scenes() {
    static const std::vector<EfficiencyScene> all{
        {"30 dominoes", "domino_speed", "speed of the wave", 3, dominoes, domino_factors},
        {"500 disks poured", "area_fraction", "area fraction after 0.6 s", 6, pouring, bed_factors},
        {"200 rough grains, bin", "grains_out", "grains out after 0.35 s", 6, bin, bed_factors}};
    return all;
}

std::vector<EfficiencyRun> efficiency_ladder(const EfficiencyScene& scene, const std::string& engine) {
    std::vector<EfficiencyRun> ladder;
    if (engine == "dem") {
        const std::vector<std::pair<double, int>> rungs{{0.2, 12}, {0.1, 12}, {0.05, 12}, {0.02, 12}, {0.02, 25}};
        for (const auto& [overlap, steps] : rungs) {
            ladder.push_back({fmt::format("overlap {}, {} steps a contact", overlap, steps), 1.0, overlap, steps});
        }
        return ladder;
    }
    for (const double factor : scene.factors(engine)) {
        ladder.push_back({fmt::format("{} critical", factor), factor, 0.0, 0});
    }
    return ladder;
}

}  // namespace polargrain
