#include "src/reproduce/bin_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/observe/bed.h"
#include "src/observe/bridges.h"
#include "src/observe/structure.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {

const Bin& rough_bin() {
    static const Bin bin{"Fig. 16",
                         "bin-rough",
                         "rough grains",
                         8,
                         4,
                         {{0.2, 0.0}, {0.3, 0.0}},
                         {0.0, 0.04, 0.10, 0.17, 0.29, 0.49, 0.57, 0.68, 0.79, 0.95},
                         "speed"};
    return bin;
}

const Bin& narrow_stick_bin() {
    static const Bin bin{"Fig. 17", "bin-sticks", "sticks", 6, 1, {{0.16, 0.0}, {0.28, 0.0}}, {}, "angle"};
    return bin;
}

const Bin& stick_bin() {
    static const Bin bin{
        "Fig. 17",
        "bin-sticks",
        "sticks",
        6,
        1,
        {{0.13, 0.0}, {0.31, 0.0}},
        {0.0, 0.75, 1.0, 1.3, 1.7, 2.3, 3.0},
        "angle",
        "-wide",
        {"walls[0].points=[[0.0, 1.2], [0.0, 0.0], [0.13, 0.0]]",
         "walls[1].points=[[0.31, 0.0], [0.44, 0.0], [0.44, 1.2]]", "walls[2].points=[[0.13, 0.0], [0.31, 0.0]]"}};
    return bin;
}

Piece bin_piece(const Bin& bin, const std::string& engine, unsigned seed) {
    std::vector<std::string> set = bin.set;
    set.push_back(fmt::format("output.trajectory.every={}", k_bin_frame));
    set.emplace_back("output.series.every=0.0");
    Piece piece = shipped_piece(bin.scenario, engine, seed, set);
    piece.name += bin.name;
    return piece;
}

std::vector<Piece> bin_pieces(const Bin& bin, const Engines& engines) {
    std::vector<Piece> pieces;
    for (const std::string& engine : engines) {
        for (unsigned seed = 1; seed <= bin.seeds; ++seed) pieces.push_back(bin_piece(bin, engine, seed));
    }
    return pieces;
}

namespace {

/// Angle of a grain's long axis from gravity [degrees]; NaN where it has none.
double tilt(const Scene& scene, const Grains& grains, GrainIndex k) {
    const auto axis = long_axis(scene.shape_of(k));
    if (!axis) return std::nan("");
    const double angle = grains.angle[Grains::at(k)] + *axis;
    return std::acos(std::min(1.0, std::abs(std::sin(angle)))) / k_radians_per_degree;
}

/// In the opening only sticks on their way count: those that have moved since the frame before. Velocities do not tell,
/// because grains of contact-1994 keep velocities that they do not move with.
void add_tilts(BinRun& run, const Bin& bin, const Scene& scene, const Grains& before, const Grains& grains) {
    constexpr double k_on_its_way = 0.3 * k_bin_frame;  // m
    const Region above{{bin.opening.from.x(), -0.02}, {bin.opening.to.x(), 0.04}};
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const double angle = tilt(scene, grains, k);
        if (!std::isfinite(angle)) return;
        const Vec2 p = grains.position(k);
        const bool moves = (p - before.position(k)).squaredNorm() > k_on_its_way * k_on_its_way;
        if (moves && above.holds(p)) run.tilt_in_opening.push_back(angle);
        if (p.y() > 0.06) run.tilt_in_bed.push_back(angle);
    }
}

BinRun read_bin(const Bin& bin, const std::filesystem::path& folder, bool tilts) {
    const TrajectoryReader recording(folder / "trajectory.h5");
    const Scene& scene = recording.scene();
    BridgeMeter bridges(scene, bin.opening, BridgeMeter::Measure::count);
    BinRun run;
    Grains previous;
    StepReport report;
    double before = 0.0;
    // A grain falls its own size in this time: as long without any, something holds them.
    const double shortest_pause = std::sqrt(2.0 * mean_outer_radius(scene) / 9.81);
    for (int f = 0; f < recording.frames(); ++f) {
        StoredFrame frame = recording.frame(f);
        const double time = frame.world.time;
        const double out = count_out(scene, frame.world.grains);
        if (f > 0 && out > run.out.y.back()) {
            if (run.last_out > 0.0 && time - run.last_out > shortest_pause) run.pauses.push_back(time - run.last_out);
            run.last_out = time;
        }
        run.out.x.push_back(time);
        run.out.y.push_back(out);
        report.contacts = std::move(frame.contacts);
        if (f > 0) bridges.step(frame.world, time - before, report);
        before = time;
        if (tilts && f % 5 == 1) add_tilts(run, bin, scene, previous, frame.world.grains);
        if (f + 1 == recording.frames()) {
            run.standing_at_end =
                find_bridge(scene, frame.world.grains, report.contacts, bin.opening).empty() ? 0.0 : 1.0;
        }
        previous = std::move(frame.world.grains);
    }
    run.bridge_lives = bridges.lives();
    return run;
}

}  // namespace

std::vector<BinRun> read_bin_runs(const FigureDesk& desk, const Bin& bin, const std::string& engine, bool tilts) {
    std::vector<BinRun> runs;
    for (unsigned seed = 1; seed <= bin.seeds; ++seed) {
        runs.push_back(read_bin(bin, desk.run(bin_piece(bin, engine, seed)), tilts));
    }
    return runs;
}

}  // namespace polargrain
