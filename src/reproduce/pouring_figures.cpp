#include <fmt/format.h>

#include <cmath>

#include "scenarios/reader.h"
#include "src/observe/bed.h"
#include "src/observe/free_surface.h"
#include "src/plot/plot.h"
#include "src/record/summary_reader.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/simulation_figures.h"
#include "src/reproduce/snapshots.h"
#include "src/reproduce/statistics.h"

namespace polargrain {

namespace {

const Engines k_pouring_engines{"contact", "contact-1994", "dem", "box2d"};
constexpr unsigned k_seeds = 4;
constexpr double k_frame = 0.02;  // between stored frames [s]
const std::vector<double> k_snapshot_times{0.0, 0.2, 0.6};
constexpr const char* k_heaped = "the surface is heaped, and fewer disks have found a place in the rows";

Piece pouring_piece(const std::string& engine, unsigned seed) {
    std::vector<std::string> set{fmt::format("output.trajectory.every={}", k_frame), "output.series.every=0.0"};
    // The paper's step of 1 ms is one for the contact model.
    if (!engine.starts_with("contact")) set.emplace_back("run.time_step=\"critical\"");
    return shipped_piece("pour-500-disks", engine, seed, set);
}

/// Potential energy over that of the hexagonal packing, at each stored frame.
Series energy_curve(const TrajectoryReader& recording, const std::string& engine, int colour) {
    Series series{.label = engine, .colour = colour};
    for (int f = 0; f < recording.frames(); ++f) {
        const StoredFrame frame = recording.frame(f);
        series.x.push_back(frame.world.time);
        series.y.push_back(potential_over_hexagonal(recording.scene(), frame.world.grains));
    }
    return series;
}

/// First time from which on the values stay within 1 % of the last one.
double settling_time(const Series& series) {
    double time = series.x.front();
    for (std::size_t k = 0; k < series.x.size(); ++k) {
        if (std::abs(series.y[k] / series.y.back() - 1.0) > 0.01 && k + 1 < series.x.size()) time = series.x[k + 1];
    }
    return time;
}

struct Pouring {
    std::vector<double> area, settling, energy, rejected, created;
    std::vector<Series> curves;
};

Pouring read_pouring(const FigureDesk& desk, const std::string& engine, int colour) {
    Pouring result;
    for (unsigned seed = 1; seed <= k_seeds; ++seed) {
        const auto folder = desk.run(pouring_piece(engine, seed));
        const StoredSummary run = read_summary(folder);
        const Series curve = energy_curve(TrajectoryReader(folder / "trajectory.h5"), engine, colour);
        result.area.push_back(run.observable("area_fraction"));
        result.rejected.push_back(100.0 * run.rejected_share());
        result.created.push_back(run.observable("energy_created_ratio"));
        result.settling.push_back(settling_time(curve));
        result.energy.push_back(curve.y.back());
        result.curves.push_back(curve);
    }
    return result;
}

std::string with_spread(const std::vector<double>& values, int decimals) {
    const MeanSpread m = mean_and_spread(values);
    return fmt::format("{:.{}f} ± {:.{}f}", m.mean, decimals, m.spread, decimals);
}

std::string literal_why(const std::string& engine) {
    return engine == "contact-1994" ? "rejected moves hold the disks up: the bed freezes before it is dense" : "";
}

void add_findings(std::vector<Finding>& findings, const std::string& engine, const Pouring& p) {
    const double area = mean_and_spread(p.area).mean;
    if (engine == "contact-1994") {
        findings.push_back({engine, "area fraction under the top disks", area, 0.78, 0.82, "",
                            "[HN94, sec. 4.2]: 0.80; Monte Carlo 0.805; Berryman's bounds 0.80 to 0.84",
                            "the bed freezes before it is dense; the paper's disks and box are unknown"});
    } else {
        findings.push_back({engine, "area fraction under the top disks", area, 0.85, 0.89, "",
                            "0.02 about the 0.870 of three soft-sphere programs; hexagonal 0.9069", k_heaped});
        findings.push_back({engine, "final potential energy over the hexagonal minimum", mean_and_spread(p.energy).mean,
                            1.005, 1.03, "", "three soft-sphere programs: 1.012 to 1.024", k_heaped});
    }
    findings.push_back({engine, "time until the potential energy stays within 1 %", mean_and_spread(p.settling).mean,
                        0.35, 0.65, "s", "[HN94, sec. 4.2]: about 0.5 s", literal_why(engine)});
}

}  // namespace

Engines at_hand(const Engines& wanted, const Engines& engines) {
    Engines found;
    for (const std::string& name : wanted) {
        if (std::find(engines.begin(), engines.end(), name) != engines.end()) found.push_back(name);
    }
    return found;
}

Piece shipped_piece(const std::string& scenario, const std::string& engine, unsigned seed,
                    const std::vector<std::string>& set) {
    ScenarioOverrides overrides{.set = set, .engine = engine, .seed = seed, .threads = std::nullopt, .no_frames = true};
    return {fmt::format("{}-{}-seed{}", scenario, engine, seed),
            load_scenario(find_scenario(scenario), overrides).resolved_toml, engine};
}

std::vector<Piece> pouring_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    for (const std::string& engine : at_hand(k_pouring_engines, engines)) {
        for (unsigned seed = 1; seed <= k_seeds; ++seed) pieces.push_back(pouring_piece(engine, seed));
    }
    return pieces;
}

FigureResult draw_fig14(const FigureDesk& desk) {
    FigureResult result;
    for (const std::string& engine : at_hand(k_pouring_engines, desk.engines())) {
        const TrajectoryReader recording(desk.run(pouring_piece(engine, 1)) / "trajectory.h5");
        FrameSettings settings;
        settings.view = {{-0.02, -0.02}, {0.42, 1.05}};
        const FrameStyle style =
            make_frame_style(settings, recording.scene(), fmt::format("Fig. 14: 500 disks, engine {}", engine));
        std::vector<LabelledFrame> cells;
        for (const double time : k_snapshot_times) {
            cells.push_back({static_cast<int>(std::lround(time / k_frame)), fmt::format("{:.1f} s", time)});
        }
        ContactSheetSettings sheet;
        sheet.columns = 3;
        sheet.width = 1100;
        const auto stem = desk.stem("fig14-" + engine);
        draw_snapshots(recording, cells, style, stem, sheet);
        result.pictures.push_back({stem, engine + ": at the printed times"});
        const StoredFrame last = recording.frame(cells.back().frame);
        double fastest = 0.0;
        for (GrainIndex k = 0; k < last.world.grains.size(); ++k) {
            fastest = std::max(fastest, std::sqrt(last.world.grains.velocity(k).squaredNorm()));
        }
        const double height = *area_under_tops(recording.scene(), last.world.grains) / 0.4;
        result.findings.push_back({engine, "mean height of the bed at 0.6 s over that of a hexagonal packing",
                                   height / (500.0 * k_pi * 1e-4 / 0.9069 / 0.4), 1.0, 1.12, "",
                                   "[HN94, Fig. 14 at 0.6 s]: a bed at rest; 0.80 to 0.9069 make 1.13 to 1",
                                   engine == "contact-1994" ? "the bed freezes before it is dense" : ""});
        result.paragraphs.push_back(fmt::format("{}: fastest disk at 0.6 s {:.3f} m/s.", engine, fastest));
    }
    result.paragraphs.insert(
        result.paragraphs.begin(),
        "500 equal frictionless disks of 20 mm, e = 0.8, in a box 0.4 m wide, from random places; the "
        "contact model with the paper's step of 1 ms, other engines with their own. Size of disks and "
        "box are not printed in the paper.");
    return result;
}

FigureResult draw_fig15(const FigureDesk& desk) {
    FigureResult result;
    Panel energy{.title = "potential energy over that of the hexagonal packing",
                 .x_label = "time [s]",
                 .y_label = "potential energy / minimum",
                 .x_range = std::pair{0.0, 1.5}};
    Panel area{.title = "area fraction under the top disks, mean and spread over seeds",
               .y_label = "area fraction",
               .y_range = std::pair{0.6, 0.95},
               .key = KeyPlace::none};
    area.levels = {{0.80, "paper 0.80"}, {0.87, "soft spheres 0.870"}, {0.9069, "hexagonal 0.9069"}};
    FigureTable table{"Pouring, mean and spread over seeds 1 to 4",
                      {"engine", "area fraction", "energy / minimum", "settled after [s]", "moves rejected [%]",
                       "energy created / E0"},
                      {}};
    const Engines engines = at_hand(k_pouring_engines, desk.engines());
    area.x_names = engines;
    area.x_range = std::pair{0.4, static_cast<double>(engines.size()) + 1.0};
    int colour = 0;
    for (const std::string& engine : engines) {
        Pouring pouring = read_pouring(desk, engine, colour);
        energy.series.push_back(pouring.curves.front());
        const MeanSpread m = mean_and_spread(pouring.area);
        area.series.push_back({.label = engine,
                               .style = SeriesStyle::points,
                               .x = {colour + 1.0},
                               .y = {m.mean},
                               .y_error = {m.spread},
                               .colour = colour});
        ++colour;
        table.rows.push_back({engine, with_spread(pouring.area, 3), with_spread(pouring.energy, 3),
                              with_spread(pouring.settling, 2), with_spread(pouring.rejected, 1),
                              with_spread(pouring.created, 2)});
        add_findings(result.findings, engine, pouring);
    }
    energy.levels = {{1.0, ""}};
    write_plot({"Fig. 15: pouring 500 disks", {energy, area}, 2, 1400, 560}, desk.stem("fig15"));
    result.paragraphs = {
        "The curve that the paper plots, the system's potential energy over the smallest possible, and the area "
        "fraction that "
        "it prints: the area of the disks over the area under the top disks.",
        "Equal disks without friction order: three independent soft-sphere programs end at 0.870. The paper's 0.80 is "
        "below "
        "that, as it must be for a method that leaves a grain where it is when its move is rejected."};
    result.pictures = {{desk.stem("fig15"), "Energy over time (seed 1), and how densely the disks lie in the end"}};
    result.tables = {std::move(table)};
    return result;
}

}  // namespace polargrain
