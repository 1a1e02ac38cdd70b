#include "src/reproduce/mixer_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/plot/plot.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/sketch.h"
#include "src/reproduce/snapshots.h"

namespace polargrain {

namespace {

constexpr double k_fewest_visits = 40.0;  // of a cell, to be drawn
constexpr double k_arrow = 0.04;          // m on the map for 1 m/s
constexpr double k_small_head = 0.004;

std::string name_of(std::size_t s) { return {k_mixer_sets[s].name}; }

Wall vessel_of(const FigureDesk& desk) {
    const TrajectoryReader recording(desk.run(mixer_piece(k_mixer_sets.front(), 1)) / "trajectory.h5");
    return recording.scene().walls.front();
}

Series vessel_outline(const Wall& vessel) {
    Series outline{.style = SeriesStyle::line, .colour = 6, .width = 1.2};
    for (const Vec2& p : vessel.points) {
        outline.x.push_back(p.x());
        outline.y.push_back(p.y());
    }
    return outline;
}

Panel map_panel(const std::string& title) {
    return {.title = title, .x_range = std::pair{-0.13, 0.13}, .y_range = std::pair{-0.005, 0.168}, .map = true};
}

Panel velocity_panel(std::size_t s, const MixerSetRuns& set, const Wall& vessel) {
    Panel panel = map_panel(name_of(s));
    Series arrows{.style = SeriesStyle::arrows, .colour = 0, .width = 1.0, .head = k_small_head};
    for (const CellField::Cell& cell : set.cells) {
        if (cell.count < k_fewest_visits) continue;
        const Vec2 by = k_arrow * cell.velocity;
        arrows.x.push_back(cell.middle.x() - 0.5 * by.x());
        arrows.y.push_back(cell.middle.y() - 0.5 * by.y());
        arrows.dx.push_back(by.x());
        arrows.dy.push_back(by.y());
    }
    panel.series = {vessel_outline(vessel), std::move(arrows), sketch_arrow({-0.0175, 0.15}, {k_arrow, 0.0}, 1),
                    sketch_text({0.0, 0.158}, "1 m/s")};
    return panel;
}

Panel temperature_panel(std::size_t s, const MixerSetRuns& set, const Wall& vessel) {
    Panel panel = map_panel(name_of(s));
    panel.z_label = "[m²/s²]";
    Series squares{.style = SeriesStyle::cells, .cell = k_mixer_cell};
    for (const CellField::Cell& cell : set.cells) {
        if (cell.count < k_fewest_visits) continue;
        squares.x.push_back(cell.middle.x());
        squares.y.push_back(cell.middle.y());
        squares.z.push_back(cell.temperature);
    }
    panel.series = {std::move(squares), vessel_outline(vessel)};
    return panel;
}

/// One scale for all but the hottest set, which would leave the others dark.
void share_scale(std::vector<Panel>& panels) {
    std::vector<double> tops;
    for (const Panel& panel : panels) tops.push_back(std::ranges::max(panel.series.front().z));
    const auto hottest = static_cast<std::size_t>(std::ranges::max_element(tops) - tops.begin());
    tops.erase(tops.begin() + static_cast<std::ptrdiff_t>(hottest));
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (k != hottest) panels[k].z_range = std::pair{0.0, std::ranges::max(tops)};
    }
    panels[hottest].title += ", on a scale of its own";
}

}  // namespace

FigurePicture draw_mixer_sheet(const FigureDesk& desk, char set) {
    const MixerSet& shown = *std::ranges::find(k_mixer_sets, set, &MixerSet::name);
    const TrajectoryReader recording(desk.run(mixer_piece(shown, 1)) / "trajectory.h5");
    FrameSettings settings;
    settings.colour = "shape";
    settings.follow = "vessel";
    settings.view = {{-0.135, -0.012}, {0.135, 0.176}};
    const FrameStyle style =
        make_frame_style(settings, recording.scene(), fmt::format("V-mixer, set {}: its fourth turn", set));
    std::vector<LabelledFrame> cells;
    for (int k = 0; k < 10; ++k) {
        const double time = (3.0 + 0.1 * k) * 60.0 / k_mixer_rate;
        int f = 0;
        while (f + 1 < recording.frames() && recording.time(f) < time) ++f;
        cells.push_back({f, fmt::format("{}°", 36 * k)});
    }
    ContactSheetSettings sheet;
    sheet.columns = 5;
    sheet.width = 1800;
    const auto stem = desk.stem(fmt::format("kuo-mixer-set-{}", set));
    draw_snapshots(recording, cells, style, stem, sheet);
    return {stem, fmt::format("Set {}: dividing (0° to 180°) and combining (180° to 360°), as in [K02, Figs. 5, 6]; "
                              "colours tell where grains started",
                              set)};
}

FigurePicture draw_mixer_rates(const FigureDesk& desk, const std::vector<MixerSetRuns>& sets) {
    Panel exchange{.title = "exchange",
                   .x_label = "turns a minute",
                   .y_label = "per grain and turn",
                   .y_range = std::pair{0.02, 3.0},
                   .log_y = true,
                   .key = KeyPlace::none};
    Panel circulation{
        .title = "circulation", .x_label = "period [s]", .y_label = "circulation time [s]", .key = KeyPlace::outside};
    for (std::size_t s = 0; s < sets.size(); ++s) {
        Series over_rate{.label = name_of(s), .style = SeriesStyle::line_points, .colour = static_cast<int>(s)};
        Series over_period = over_rate;
        for (std::size_t k = 0; k < k_mixer_rates.size(); ++k) {
            over_rate.x.push_back(k_mixer_rates[k]);
            over_rate.y.push_back(sets[s].by_rate[k].exchange);
            over_period.x.push_back(60.0 / k_mixer_rates[k]);
            over_period.y.push_back(sets[s].by_rate[k].circulation);
        }
        exchange.series.push_back(std::move(over_rate));
        circulation.series.push_back(std::move(over_period));
    }
    write_plot({"The eight sets at three speeds", {exchange, circulation}, 2, 1500, 560}, desk.stem("kuo-mixer-rates"));
    return {desk.stem("kuo-mixer-rates"),
            "Exchange and circulation time over the speed of the mixer, seed 1, after [K02, Figs. 12, 14]"};
}

FigurePicture draw_mixer_velocities(const FigureDesk& desk, const std::vector<MixerSetRuns>& sets) {
    const Wall vessel = vessel_of(desk);
    Plot plot{.title = "Mean velocity, seen from the vessel", .columns = 4, .width = 1800, .height = 720};
    for (std::size_t s = 0; s < sets.size(); ++s) plot.panels.push_back(velocity_panel(s, sets[s], vessel));
    write_plot(plot, desk.stem("kuo-mixer-velocity"));
    return {desk.stem("kuo-mixer-velocity"), "Velocity per cell of 7.35 mm, mean over all visits, after [K02, Fig. 7]"};
}

FigurePicture draw_mixer_temperatures(const FigureDesk& desk, const std::vector<MixerSetRuns>& sets) {
    const Wall vessel = vessel_of(desk);
    Plot plot{.title = "Granular temperature", .columns = 4, .width = 1800, .height = 700};
    for (std::size_t s = 0; s < sets.size(); ++s) plot.panels.push_back(temperature_panel(s, sets[s], vessel));
    share_scale(plot.panels);
    write_plot(plot, desk.stem("kuo-mixer-temperature"));
    return {desk.stem("kuo-mixer-temperature"), "Granular temperature per cell, after [K02, Fig. 11]"};
}

}  // namespace polargrain
