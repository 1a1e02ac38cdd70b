#include <cmath>

#include "src/compare/comparison.h"
#include "src/plot/plot.h"

namespace polargrain {

namespace {

constexpr std::size_t k_bars = 10;  ///< error bars along a line
constexpr int k_panel_width = 620;
constexpr int k_panel_height = 400;

/// The mean over time, and at a few ticks, shifted from engine to engine, its standard deviation.
void add_engine(const Comparison& comparison, std::size_t engine, std::size_t quantity, Panel& panel) {
    Series line;
    line.label = comparison.engines[engine];
    line.colour = static_cast<int>(engine);
    Series bars;
    bars.style = SeriesStyle::points;
    bars.colour = line.colour;
    const std::size_t ticks = comparison.ticks();
    const std::size_t stride = std::max<std::size_t>(1, ticks / k_bars);
    const std::size_t shift = (engine + 1) * stride / (comparison.engines.size() + 1);
    for (std::size_t tick = 0; tick < ticks; ++tick) {
        const Spread spread = comparison.spread_at(engine, quantity, tick);
        if (!std::isfinite(spread.mean)) continue;
        const double time = static_cast<double>(tick) * comparison.clock.every;
        line.x.push_back(time);
        line.y.push_back(spread.mean);
        if (comparison.seeds() == 1 || tick % stride != shift) continue;
        bars.x.push_back(time);
        bars.y.push_back(spread.mean);
        bars.y_error.push_back(spread.deviation);
    }
    panel.series.push_back(std::move(line));
    if (!bars.x.empty()) panel.series.push_back(std::move(bars));
}

}  // namespace

void write_plots(const Comparison& comparison, const std::filesystem::path& folder) {
    Plot plot;
    plot.title = comparison.title;
    plot.columns = 2;
    for (std::size_t q = 0; q < comparison.quantities().size(); ++q) {
        if (comparison.nothing_to_see(q)) continue;
        const Quantity& quantity = comparison.quantities()[q];
        Panel panel;
        panel.title = quantity.name;
        panel.x_label = "time [s]";
        panel.y_label = quantity.unit.empty() ? "" : "[" + quantity.unit + "]";
        panel.x_range = {0.0, static_cast<double>(comparison.ticks() - 1) * comparison.clock.every};
        panel.key = plot.panels.empty() ? KeyPlace::top_right : KeyPlace::none;
        for (std::size_t e = 0; e < comparison.engines.size(); ++e) add_engine(comparison, e, q, panel);
        plot.panels.push_back(std::move(panel));
    }
    if (plot.panels.empty()) return;
    const int rows = static_cast<int>((plot.panels.size() + 1) / 2);
    plot.width = 2 * k_panel_width;
    plot.height = rows * k_panel_height;
    write_plot(plot, folder / "observables");
}

}  // namespace polargrain
