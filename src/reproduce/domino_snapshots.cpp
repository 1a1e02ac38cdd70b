#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/plot/plot.h"
#include "src/record/summary_reader.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/dominoes.h"
#include "src/reproduce/simulation_figures.h"
#include "src/reproduce/snapshots.h"
#include "src/reproduce/statistics.h"
#include "src/theory/domino_chain.h"
#include "src/theory/domino_theory.h"

namespace polargrain {

namespace {

constexpr double k_snapshot_gap = 1.7;
constexpr double k_frame = 1e-3;  // between stored frames [s]
constexpr int k_first_shown = 14;
const std::vector<double> k_snapshot_times{0.0, 7e-3, 14e-3, 19e-3, 26e-3, 33e-3, 39e-3, 46e-3, 53e-3, 59e-3};

Piece snapshot_piece(const std::string& engine) {
    return domino_piece(table_1().front(), k_snapshot_gap, k_rough_table, engine, k_frame);
}

/// Frame at which each domino has first turned by more than 0.02 rad; -1 where it never does.
std::vector<int> struck_frames(const TrajectoryReader& recording) {
    std::vector<int> struck(recording.scene().grains.x.size(), -1);
    const std::vector<double> start = recording.scene().grains.angle;
    for (int f = 0; f < recording.frames(); ++f) {
        const StoredFrame frame = recording.frame(f);
        for (std::size_t k = 0; k < struck.size(); ++k) {
            if (struck[k] < 0 && std::abs(frame.world.grains.angle[k] - start[k]) > 0.02) struck[k] = f;
        }
    }
    return struck;
}

/// How often each pair of neighbours in the steady half comes into contact until both have turned by a quarter radian:
/// stored contacts that follow a stored frame without one.
std::vector<double> contact_counts(const TrajectoryReader& recording) {
    const int count = static_cast<int>(recording.scene().grains.x.size());
    std::vector<double> times(static_cast<std::size_t>(count), 0.0);
    std::vector<char> before(static_cast<std::size_t>(count), 0);
    for (int f = 0; f < recording.frames(); ++f) {
        const StoredFrame frame = recording.frame(f);
        std::vector<char> now(static_cast<std::size_t>(count), 0);
        for (const Contact& c : frame.contacts) {
            if (is_wall(c.a) || c.b != c.a + 1) continue;
            now[static_cast<std::size_t>(c.a)] =
                std::abs(frame.world.grains.angle[static_cast<std::size_t>(c.b)]) < 0.25;
        }
        for (std::size_t k = 0; k < now.size(); ++k) times[k] += now[k] && !before[k];
        before = now;
    }
    return {times.begin() + count / 2, times.end() - 2};
}

FigurePicture draw_row(const FigureDesk& desk, const std::string& engine, const TrajectoryReader& recording, int zero) {
    const DominoKind& kind = table_1().front();
    const double pitch = kind.thickness * (1.0 + k_snapshot_gap);
    FrameSettings settings;
    settings.colour = "speed";
    settings.colour_max = 1.0;
    settings.view = {{(k_first_shown - 6.5) * pitch, -0.006}, {(k_first_shown + 6.0) * pitch, 0.055}};
    const FrameStyle style = make_frame_style(settings, recording.scene(),
                                              fmt::format("Fig. 12: Opalene, spacing 1.7 h, engine {}", engine));
    std::vector<LabelledFrame> cells;
    for (const double time : k_snapshot_times) {
        const int f = std::min(zero + static_cast<int>(std::lround(time / k_frame)), recording.frames() - 1);
        cells.push_back({f, fmt::format("{:.0f} ms", 1e3 * time)});
    }
    ContactSheetSettings sheet;
    sheet.columns = 2;
    sheet.width = 1500;
    const auto stem = desk.stem("fig12-" + engine);
    draw_snapshots(recording, cells, style, stem, sheet);
    return {stem,
            fmt::format("{}: the row at the printed times; zero is when domino {} is struck", engine, k_first_shown)};
}

}  // namespace

std::vector<Piece> fig12_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    for (const std::string& engine : at_hand(domino_engines(), engines)) pieces.push_back(snapshot_piece(engine));
    return pieces;
}

FigureResult draw_fig12(const FigureDesk& desk) {
    FigureResult result;
    const DominoKind& kind = table_1().front();
    const double pitch = kind.thickness * (1.0 + k_snapshot_gap);
    const double chain = pinned_chain_speed(kind.row(k_snapshot_gap), 70, k_chain_step);
    Panel wave{.title = "when each domino is struck",
               .x_label = "domino",
               .y_label = "time [s]",
               .x_range = std::pair{0.0, 48.0},
               .key = KeyPlace::top_left};
    Panel contacts{.title = "how often neighbours meet",
                   .x_label = "times in contact until turned by 0.25 rad",
                   .y_label = "pairs of neighbours"};
    int colour = 0;
    for (const std::string& engine : at_hand(domino_engines(), desk.engines())) {
        const auto folder = desk.run(snapshot_piece(engine));
        const TrajectoryReader recording(folder / "trajectory.h5");
        const std::vector<int> struck = struck_frames(recording);
        const int zero = std::max(0, struck[k_first_shown]);
        result.pictures.push_back(draw_row(desk, engine, recording, zero));
        Series line{.label = engine, .style = SeriesStyle::line_points, .colour = colour};
        for (std::size_t k = 0; k < struck.size(); ++k) {
            line.x.push_back(static_cast<double>(k));
            line.y.push_back(struck[k] < 0 ? std::nan("") : k_frame * struck[k]);
        }
        wave.series.push_back(line);
        const std::vector<double> counts = contact_counts(recording);
        Series meetings = histogram(counts, 0.5, 8.5, 8, engine, colour++);
        meetings.style = SeriesStyle::line_points;
        contacts.series.push_back(std::move(meetings));
        const auto once = std::count(counts.begin(), counts.end(), 1.0);
        const double speed = read_summary(folder).observable("domino_speed");
        result.findings.push_back({engine, "speed V / √(g L) at spacing 1.7 h", speed, 1.45, 1.65, "",
                                   fmt::format("four physics engines 1.45 to 1.65; chain {:.3f}, group theory {:.3f}",
                                               chain, group_theory_speed(kind.row(k_snapshot_gap))),
                                   engine == "contact-1994" ? "moves rejected while neighbours touch" : ""});
        result.findings.push_back(
            {engine, "dominoes that the wave passes in the printed 59 ms", speed * kind.speed_unit() * 0.059 / pitch,
             0.94 * chain * kind.speed_unit() * 0.059 / pitch, 1.06 * chain * kind.speed_unit() * 0.059 / pitch, "",
             "pinned-foot chain within 6 %", ""});
        result.findings.push_back({engine, "pairs that meet more than once, share of all",
                                   1.0 - static_cast<double>(once) / static_cast<double>(counts.size()), 0.05, 1.0, "",
                                   "[HN94, sec. 4.1]: single and multiple collisions and sliding contacts side by side",
                                   ""});
    }
    write_plot({"Fig. 12: the wave", {wave, contacts}, 2, 1300, 480}, desk.stem("fig12-wave"));
    result.pictures.push_back({desk.stem("fig12-wave"), "The wave, and how often neighbours come into contact"});
    result.paragraphs = {
        fmt::format("Opalene dominoes at λ = 1.7 h on a table with μ = 1.5. The paper's ten frames span 59 ms, in "
                    "which the wave passes "
                    "{:.1f} dominoes by the chain theory: its time zero must lie in the steady wave. Ours is the "
                    "instant at which domino "
                    "{} is struck. Frames are stored every millisecond.",
                    chain * kind.speed_unit() * 0.059 / pitch, k_first_shown)};
    return result;
}

}  // namespace polargrain
