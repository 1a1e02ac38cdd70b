#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "src/plot/plot.h"
#include "src/record/summary_reader.h"
#include "src/reproduce/efficiency_ladder.h"
#include "src/reproduce/efficiency_scenes.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {

namespace {

const Engines k_compared{"contact", "contact-1994", "dem", "box2d"};
constexpr const char* k_soft = "dem";
/// Two methods that share the shapes and nothing else: where both lead, when refined, is what is right.
const Engines k_trusted{"contact", k_soft};
constexpr std::array k_tolerances{0.10, 0.05, 0.02};
constexpr double k_stated = 0.05;       ///< the tolerance of the verdicts
constexpr double k_least_drawn = 1e-3;  ///< errors below are drawn here, as a logarithm has no zero

/// All ladders of one scene.
struct Ladders {
    ConvergedValue converged;
    std::map<std::string, std::vector<RungResult>> of;  ///< by engine, coarse to fine

    std::optional<RungResult> right(const std::string& engine, double tolerance) const {
        const auto found = of.find(engine);
        return found == of.end() ? std::nullopt : cheapest_right(found->second, tolerance);
    }
};

Rung read_rung(const FigureDesk& desk, const EfficiencyScene& scene, const std::string& engine,
               const EfficiencyRun& step) {
    Rung rung{step.label, {}, {}};
    for (unsigned beginning = 1; beginning <= scene.beginnings; ++beginning) {
        const StoredSummary run = read_summary(desk.run(scene.piece(engine, step, beginning)));
        rung.values.push_back(run.observable(scene.observable));
        rung.costs.push_back(run.cpu_seconds / run.simulated_seconds);
    }
    return rung;
}

Ladders read_ladders(const FigureDesk& desk, const EfficiencyScene& scene, const Engines& engines) {
    std::map<std::string, std::vector<Rung>> rungs;
    for (const std::string& engine : engines) {
        for (const EfficiencyRun& step : efficiency_ladder(scene, engine)) {
            rungs[engine].push_back(read_rung(desk, scene, engine, step));
        }
    }
    std::vector<Rung> finest;
    for (const std::string& engine : at_hand(k_trusted, engines)) finest.push_back(rungs[engine].back());
    Ladders ladders{converged_value(finest), {}};
    for (const auto& [engine, steps] : rungs) {
        for (const Rung& rung : steps) ladders.of[engine].push_back(rung_result(rung, ladders.converged));
    }
    return ladders;
}

/// The key stands in the first panel of the plot.
Panel error_panel(const EfficiencyScene& scene, const Ladders& ladders, const Engines& engines, bool first) {
    Panel panel{.title = scene.name + ": " + scene.quantity,
                .x_label = "processor time per simulated second [s]",
                .y_label = "error",
                .y_range = std::pair{k_least_drawn, 1.0},
                .log_x = true,
                .log_y = true,
                .key = first ? KeyPlace::top_right : KeyPlace::none};
    int colour = 0;
    for (const std::string& engine : engines) {
        Series series{.label = engine, .style = SeriesStyle::line_points, .colour = colour++};
        for (const RungResult& rung : ladders.of.at(engine)) {
            const double error = std::max(rung.error, k_least_drawn);
            series.x.push_back(rung.cost);
            series.y.push_back(error);
            series.y_error.push_back(std::min(rung.uncertainty, error - 0.5 * k_least_drawn));
        }
        panel.series.push_back(std::move(series));
    }
    const double known = ladders.converged.uncertainty / std::abs(ladders.converged.value);
    panel.levels = {{k_stated, "5 %"}, {std::max(known, k_least_drawn), "converged value"}};
    return panel;
}

void add_rungs(FigureTable& table, const EfficiencyScene& scene, const Ladders& ladders, const Engines& engines) {
    for (const std::string& engine : engines) {
        for (const RungResult& rung : ladders.of.at(engine)) {
            table.rows.push_back({scene.name, engine, rung.label, fmt::format("{:.3g}", rung.cost),
                                  fmt::format("{:.4g} ± {:.2g}", rung.value, rung.spread),
                                  fmt::format("{:.1f} ± {:.1f}", 100.0 * rung.error, 100.0 * rung.uncertainty)});
        }
    }
}

std::string cost_text(const std::optional<RungResult>& right) {
    return right ? fmt::format("{:.3g} ({})", right->cost, right->label) : "never";
}

void add_costs(FigureTable& table, const EfficiencyScene& scene, const Ladders& ladders, const Engines& engines) {
    for (const double tolerance : k_tolerances) {
        std::vector<std::string> row{
            scene.name, fmt::format("{:.4g} ± {:.2g}", ladders.converged.value, ladders.converged.uncertainty),
            fmt::format("{:.0f} %", 100.0 * tolerance)};
        for (const std::string& engine : engines) row.push_back(cost_text(ladders.right(engine, tolerance)));
        table.rows.push_back(std::move(row));
    }
}

/// How many times cheaper than the soft engine at equal error, for each contact engine.
void add_verdicts(std::vector<Finding>& findings, const EfficiencyScene& scene, const Ladders& ladders,
                  const Engines& engines) {
    const auto soft = ladders.right(k_soft, k_stated);
    for (const std::string& engine : at_hand({"contact-1994", "contact"}, engines)) {
        const auto right = ladders.right(engine, k_stated);
        Finding finding{engine,
                        scene.name + ": processor time of springs and dashpots over this, both right to 5 %",
                        soft && right ? soft->cost / right->cost : std::nan(""),
                        5.0,
                        20.0,
                        "",
                        "[HN94, sec. 4.4]: about an order of magnitude",
                        ""};
        if (!right) finding.why = "no time step of this engine gives the " + scene.quantity;
        if (!soft) finding.why = "no stiffness of the springs gives the " + scene.quantity;
        if (soft && right && finding.measured < finding.lowest) {
            finding.why = "soft contacts are cheap where grains are few or round, and lasting contacts cost iterations";
        }
        if (finding.measured > finding.highest) finding.why = "springs that are stiff enough need short steps";
        findings.push_back(std::move(finding));
    }
}

}  // namespace

std::vector<Piece> efficiency_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    for (const EfficiencyScene& scene : efficiency_scenes()) {
        for (const std::string& engine : at_hand(k_compared, engines)) {
            for (const EfficiencyRun& run : efficiency_ladder(scene, engine)) {
                for (unsigned beginning = 1; beginning <= scene.beginnings; ++beginning) {
                    pieces.push_back(scene.piece(engine, run, beginning));
                }
            }
        }
    }
    return pieces;
}

FigureResult draw_efficiency(const FigureDesk& desk) {
    FigureResult result;
    const Engines engines = at_hand(k_compared, desk.engines());
    FigureTable costs{"Processor time per simulated second with the coarsest step that is right to a tolerance [s]",
                      {"simulation", "converged value", "tolerance"},
                      {}};
    costs.header.insert(costs.header.end(), engines.begin(), engines.end());
    FigureTable rungs{"Every step: one thread, nothing recorded; mean and spread over runs, standard errors",
                      {"simulation", "engine", "step", "processor time per simulated second [s]", "value", "error [%]"},
                      {}};
    Plot plot{"Section 4.4: error over cost", {}, 3, 1700, 560};
    for (const EfficiencyScene& scene : efficiency_scenes()) {
        const Ladders ladders = read_ladders(desk, scene, engines);
        plot.panels.push_back(error_panel(scene, ladders, engines, plot.panels.empty()));
        add_rungs(rungs, scene, ladders, engines);
        add_costs(costs, scene, ladders, engines);
        add_verdicts(result.findings, scene, ladders, engines);
    }
    write_plot(plot, desk.stem("efficiency"));
    result.pictures = {{desk.stem("efficiency"),
                        "Error of an observable over processor time, from coarse steps to fine ones; error bars are "
                        "standard errors over runs from different beginnings. Dotted: 5 %, and how well the converged "
                        "value is known"}};
    result.tables = {std::move(costs), std::move(rungs)};
    result.paragraphs = {
        "The paper finds the contact model about ten times as fast as springs and dashpots, from a few simple "
        "examples, without numbers. Here the same scenes go through every engine, each with a ladder of time steps. "
        "The step of the soft engine follows from the stiffness of its springs, given by how deep, over the inner "
        "radius, the fastest possible impact may press grains into one another.",
        "The converged value is the mean of the finest runs of the engines contact and dem, which share the shapes and "
        "nothing else; half their difference, or the standard error if that is larger, is how well it is known. A step "
        "counts as right if it and all finer ones are."};
    return result;
}

}  // namespace polargrain
