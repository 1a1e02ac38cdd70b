#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/observe/bed.h"
#include "src/plot/plot.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/bin_runs.h"
#include "src/reproduce/simulation_figures.h"
#include "src/reproduce/snapshots.h"
#include "src/reproduce/statistics.h"

namespace polargrain {

namespace {

const Engines k_bin_engines{"contact", "contact-1994"};

FigurePicture draw_snapshots(const FigureDesk& desk, const Bin& bin, const std::string& id, const std::string& engine) {
    const TrajectoryReader recording(desk.run(bin_piece(bin, engine, bin.shown_seed)) / "trajectory.h5");
    FrameSettings settings;
    settings.colour = bin.colour;
    const auto [left, right] = wall_width(recording.scene());
    settings.view = {{left - 0.06, -0.25}, {right + 0.06, 0.62}};
    const FrameStyle style =
        make_frame_style(settings, recording.scene(),
                         fmt::format("{}: {}, engine {}, seed {}", bin.figure, bin.grains, engine, bin.shown_seed));
    std::vector<LabelledFrame> cells;
    for (const double time : bin.snapshot_times) {
        const int f = std::min(static_cast<int>(std::lround(time / k_bin_frame)), recording.frames() - 1);
        cells.push_back({f, fmt::format("{:.2f} s", time)});
    }
    ContactSheetSettings sheet;
    sheet.columns = cells.size() > 8 ? 5 : 4;
    sheet.width = 1800;
    const auto stem = desk.stem(id + "-" + engine);
    draw_snapshots(recording, cells, style, stem, sheet);
    return {stem, fmt::format("{}: at the printed times, seed {}", engine, bin.shown_seed)};
}

/// Mean over seeds at each stored time, and its spread at ten of them.
std::pair<Series, Series> mean_curve(const std::vector<BinRun>& runs, const std::string& engine, int colour) {
    Series mean{.label = engine + ", mean and spread", .colour = colour, .width = 3.5};
    Series spread{.style = SeriesStyle::points, .colour = colour};
    const std::size_t frames = runs.front().out.x.size();
    for (std::size_t f = 0; f < frames; ++f) {
        std::vector<double> values;
        for (const BinRun& run : runs) values.push_back(f < run.out.y.size() ? run.out.y[f] : std::nan(""));
        const MeanSpread m = mean_and_spread(values);
        mean.x.push_back(runs.front().out.x[f]);
        mean.y.push_back(m.mean);
        // Each engine's marks a little aside, so that they do not cover one another.
        if ((f + static_cast<std::size_t>(colour) * frames / 40) % (frames / 10) != 0 || f == 0) continue;
        spread.x.push_back(runs.front().out.x[f]);
        spread.y.push_back(m.mean);
        spread.y_error.push_back(m.spread);
    }
    return {std::move(mean), std::move(spread)};
}

template <typename Value>
std::vector<double> over_seeds(const std::vector<BinRun>& runs, Value value) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const BinRun& run : runs) values.push_back(value(run));
    return values;
}

std::vector<double> all_pauses(const std::vector<BinRun>& runs) {
    std::vector<double> pauses;
    for (const BinRun& run : runs) pauses.insert(pauses.end(), run.pauses.begin(), run.pauses.end());
    return pauses;
}

std::vector<std::string> seed_row(const std::string& engine, unsigned seed, const BinRun& run) {
    std::string lives;
    std::string pauses;
    for (const double pause : run.pauses) pauses += fmt::format("{}{:.2f}", pauses.empty() ? "" : ", ", pause);
    for (const double life : run.bridge_lives) lives += fmt::format("{}{:.2f}", lives.empty() ? "" : ", ", life);
    return {engine,
            fmt::format("{}", seed),
            fmt::format("{:.0f}", run.out.y.back()),
            fmt::format("{:.2f}", run.last_out),
            pauses.empty() ? "none" : pauses,
            lives.empty() ? "none" : lives,
            run.standing_at_end > 0.0 ? "yes" : "no"};
}

const std::vector<std::string> k_seed_header{"engine",
                                             "seed",
                                             "grains out",
                                             "last one out at [s]",
                                             "pauses of the flow [s]",
                                             "arches at rest, lives [s]",
                                             "one stands at the end"};

constexpr const char* k_frozen =
    "rejected moves: the bed freezes where it touches itself, and gravity works on grains that do not move";

/// `why_it_ends`: the reason where most seeds flow no longer.
void add_bridge_findings(std::vector<Finding>& findings, const std::string& engine, const std::vector<BinRun>& runs,
                         const std::string& why_it_ends) {
    const double end = runs.front().out.x.back();
    const auto per_run = [&](auto value) { return mean_and_spread(over_seeds(runs, value)).mean; };
    const std::string frozen = engine == "contact-1994" ? k_frozen : "";
    findings.push_back({engine, "pauses of the flow that end again, per run, mean over seeds",
                        per_run([](const BinRun& r) { return static_cast<double>(r.pauses.size()); }), 0.5, 1e3, "",
                        "temporary bridges form above the opening and collapse",
                        "where a bridge forms here it lasts, or the flow never stops"});
    findings.push_back({engine, "mean length of these pauses", mean_and_spread(all_pauses(runs)).mean, 0.0, 0.25, "s",
                        "each bridge collapses quickly in response to impacts", frozen});
    findings.push_back({engine, "seeds that flow in the last quarter, share",
                        per_run([&](const BinRun& r) { return r.last_out > 0.75 * end ? 1.0 : 0.0; }), 0.5, 1.0, "",
                        "the printed run flows until its last picture", why_it_ends});
}

/// Grains per second that the law of 2D silos gives for disks of the same mean size: Q = C (D/d - k)^1.5 in units of
/// area sqrt(g) d^1.5 through the two measured points Q(6) = 8.05 and Q(10) = 20.6.
double disks_per_second(const Scene& scene, const Opening& opening) {
    const double d = 2.0 * mean_outer_radius(scene);
    const double ratio = std::cbrt((20.6 / 8.05) * (20.6 / 8.05));
    const double k = (6.0 * ratio - 10.0) / (ratio - 1.0);
    const double c = 8.05 / std::sqrt((6.0 - k) * (6.0 - k) * (6.0 - k));
    const double width = std::sqrt((opening.to - opening.from).squaredNorm());
    const double over = std::max(0.0, width / d - k);
    const double area = c * std::sqrt(over * over * over) * std::sqrt(9.81) * std::sqrt(d * d * d);
    return area / (k_pi * d * d / 4.0);
}

Panel discharge_panel(const std::string& grains) {
    return {.title = "discharge, each seed thin",
            .x_label = "time since opening [s]",
            .y_label = grains + " out",
            .key = KeyPlace::top_left};
}

void add_discharge(Panel& panel, const std::vector<BinRun>& runs, const std::string& engine, int colour) {
    for (const BinRun& run : runs) {
        Series thin = run.out;
        thin.colour = colour;
        thin.width = 0.6;
        panel.series.push_back(std::move(thin));
    }
    auto [mean, spread] = mean_curve(runs, engine, colour);
    panel.series.push_back(std::move(mean));
    panel.series.push_back(std::move(spread));
    double most = panel.y_range ? panel.y_range->second : 1.0;
    for (const BinRun& run : runs) most = std::max(most, 1.4 * run.out.y.back());
    panel.x_range = std::pair{0.0, runs.front().out.x.back()};
    panel.y_range = std::pair{0.0, most};
}

}  // namespace

std::vector<Piece> fig16_pieces(const Engines& engines) {
    return bin_pieces(rough_bin(), at_hand(k_bin_engines, engines));
}

std::vector<Piece> fig17_pieces(const Engines& engines) {
    std::vector<Piece> pieces = bin_pieces(stick_bin(), at_hand(k_bin_engines, engines));
    for (Piece& piece : bin_pieces(narrow_stick_bin(), at_hand({"contact"}, engines)))
        pieces.push_back(std::move(piece));
    return pieces;
}

FigureResult draw_fig16(const FigureDesk& desk) {
    const Bin& bin = rough_bin();
    FigureResult result;
    Panel discharge = discharge_panel(bin.grains);
    Panel pauses{.title = "how long the flow pauses", .x_label = "pause [s]", .y_label = "pauses per 30 ms, all seeds"};
    FigureTable table{"Every run", k_seed_header, {}};
    int colour = 0;
    for (const std::string& engine : at_hand(k_bin_engines, desk.engines())) {
        const std::vector<BinRun> runs = read_bin_runs(desk, bin, engine, false);
        result.pictures.push_back(draw_snapshots(desk, bin, "fig16", engine));
        add_discharge(discharge, runs, engine, colour);
        Series counts = histogram(all_pauses(runs), 0.04, 0.34, 10, engine, colour++);
        counts.style = SeriesStyle::line_points;
        pauses.series.push_back(std::move(counts));
        for (unsigned s = 0; s < runs.size(); ++s) table.rows.push_back(seed_row(engine, s + 1, runs[s]));
        const TrajectoryReader recording(desk.run(bin_piece(bin, engine, 1)) / "trajectory.h5");
        const double law = disks_per_second(recording.scene(), bin.opening) * runs.front().out.x.back();
        result.findings.push_back(
            {engine, "grains out after 1 s, mean over seeds",
             mean_and_spread(over_seeds(runs, [](const BinRun& r) { return r.out.y.back(); })).mean, 0.4 * law,
             1.1 * law, "",
             fmt::format("law of 2D silos for disks of that size: {:.0f}; rough grains interlock, so up to 60 % fewer",
                         law),
             engine == "contact-1994" ? k_frozen : ""});
        add_bridge_findings(result.findings, engine, runs,
                            "the opening is on the edge of jamming: most seeds block for good");
    }
    write_plot({"Fig. 16: rough grains out of a square bin", {discharge, pauses}, 2, 1400, 560},
               desk.stem("fig16-flow"));
    result.pictures.push_back(
        {desk.stem("fig16-flow"), "Discharge over seeds, and pauses of the flow: temporary bridges"});
    result.paragraphs = {fmt::format(
        "500 rough grains, μ = 0.2 among them and against the walls, out of a bin whose opening is five diameters "
        "wide; {} "
        "seeds. The flow pauses where no grain leaves for longer than one takes to fall its own size: a temporary "
        "bridge. An arch at rest is a chain of resting grains in contact from one side of the opening to the "
        "other; grains of contact-1994 keep velocities that they do not move with, and so never rest. Frames are "
        "stored every 5 ms.",
        bin.seeds)};
    result.tables = {std::move(table)};
    return result;
}

FigureResult draw_fig17(const FigureDesk& desk) {
    const Bin& bin = stick_bin();
    FigureResult result;
    Panel discharge = discharge_panel(bin.grains);
    Panel orientation{.title = "long axes, angle from the vertical",
                      .x_label = "angle from the vertical [°]",
                      .y_label = "share per 10°",
                      .key = KeyPlace::top_right};
    FigureTable table{"Every run", k_seed_header, {}};
    int colour = 0;
    for (const std::string& engine : at_hand(k_bin_engines, desk.engines())) {
        const std::vector<BinRun> runs = read_bin_runs(desk, bin, engine, true);
        result.pictures.push_back(draw_snapshots(desk, bin, "fig17", engine));
        add_discharge(discharge, runs, engine + ", 3.6 lengths", colour);
        std::vector<double> opening, bed;
        for (const BinRun& run : runs) {
            opening.insert(opening.end(), run.tilt_in_opening.begin(), run.tilt_in_opening.end());
            bed.insert(bed.end(), run.tilt_in_bed.begin(), run.tilt_in_bed.end());
        }
        for (const auto& [angles, where, dashed] :
             {std::tuple{&opening, "in the opening", false}, {&bed, "in the bed", true}}) {
            Series shares = histogram(*angles, 0.0, 90.0, 9, engine + ", " + where, colour);
            for (double& count : shares.y) count /= std::max(1.0, static_cast<double>(angles->size()));
            shares.style = dashed ? SeriesStyle::dashed : SeriesStyle::line_points;
            orientation.series.push_back(std::move(shares));
        }
        ++colour;
        const auto order = [](const std::vector<double>& angles) {
            std::vector<double> cosines;
            for (const double a : angles) cosines.push_back(std::cos(2.0 * a * k_radians_per_degree));
            return mean_and_spread(cosines).mean;
        };
        for (unsigned s = 0; s < runs.size(); ++s) table.rows.push_back(seed_row(engine, s + 1, runs[s]));
        result.findings.push_back({engine, "order along the flow of sticks that pass the opening, <cos 2α>",
                                   order(opening), 0.05, 1.0, "",
                                   "[HN94, sec. 4.3.2]: grains align through the opening",
                                   "sticks tip over the edges of the opening, and fall through it aslant"});
        result.findings.push_back({engine, "the same in the bed above", order(bed), -1.0, 0.0, "",
                                   "settled sticks lie flat, [HN94, Fig. 17 at 0 s]", ""});
        add_bridge_findings(result.findings, engine, runs,
                            "most seeds have run out by then, down to the heaps beside the opening, or block for good");
    }
    for (const std::string& engine : at_hand({"contact"}, desk.engines())) {
        const std::vector<BinRun> narrow = read_bin_runs(desk, narrow_stick_bin(), engine, false);
        add_discharge(discharge, narrow, engine + ", 2.4 lengths", colour);
        for (unsigned s = 0; s < narrow.size(); ++s) {
            table.rows.push_back(seed_row(engine + ", 2.4 lengths", s + 1, narrow[s]));
        }
    }
    write_plot({"Fig. 17: sticks out of a square bin", {discharge, orientation}, 2, 1400, 560},
               desk.stem("fig17-flow"));
    result.pictures.push_back({desk.stem("fig17-flow"), "Discharge over seeds, and directions of the sticks"});
    result.paragraphs = {fmt::format(
        "160 sticks 5 times as long as wide; μ 0.4 and e 0.3 among them, 0.3 and 0.5 against the walls; {} seeds. The "
        "paper does not say how wide its opening is. Ours is 3.6 stick lengths wide; with 2.4 lengths, as in "
        "the shipped scenario, the third curve, the sticks soon block. Pauses and arches are counted as in Fig. 16.",
        bin.seeds)};
    result.tables = {std::move(table)};
    return result;
}

}  // namespace polargrain
