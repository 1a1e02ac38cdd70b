#include <fmt/format.h>

#include <cmath>

#include "src/plot/plot.h"
#include "src/reproduce/dominoes.h"
#include "src/reproduce/recorded_run.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {

namespace {

const Engines k_compared{"contact-1994", "contact", "dem", "box2d"};
constexpr const char* k_soft = "dem";

/// A kind of simulation that the paper speaks of, and the piece it is measured on.
struct Task {
    std::string name;
    Piece (*piece)(const std::string& engine);
};

Piece dominoes(const std::string& engine) { return domino_piece(table_1().front(), 2.0, k_rough_table, engine); }

/// A shipped scenario with nothing recorded, and cut short: enough to tell what it costs.
Piece timed(const std::string& scenario, const std::string& engine, unsigned seed, std::vector<std::string> set) {
    set.insert(set.end(), {"output.trajectory.every=0.0", "output.series.every=0.0"});
    if (!engine.starts_with("contact")) set.emplace_back("run.time_step=\"critical\"");
    Piece piece = shipped_piece(scenario, engine, seed, set);
    piece.name += "-timed";
    return piece;
}

Piece pouring(const std::string& engine) { return timed("pour-500-disks", engine, 1, {"run.duration=0.6"}); }
Piece bin(const std::string& engine) {
    return timed("bin-rough", engine, 4, {"run.duration=0.3", "settle.at_most=0.3"});
}

const std::vector<Task>& tasks() {
    static const std::vector<Task> all{
        {"48 dominoes", dominoes}, {"500 disks poured", pouring}, {"500 rough grains, bin", bin}};
    return all;
}

}  // namespace

std::vector<Piece> efficiency_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    for (const Task& task : tasks()) {
        for (const std::string& engine : at_hand(k_compared, engines)) pieces.push_back(task.piece(engine));
    }
    return pieces;
}

FigureResult draw_efficiency(const FigureDesk& desk) {
    FigureResult result;
    const Engines engines = at_hand(k_compared, desk.engines());
    FigureTable table{"Processor time, one thread, nothing recorded",
                      {"simulation", "engine", "time step [s]", "steps", "processor time [s]",
                       "per simulated second [s]", "per grain and step [µs]"},
                      {}};
    Panel panel{.title = "processor time per simulated second",
                .y_label = "[s] per simulated [s]",
                .x_range = std::pair{0.5, static_cast<double>(tasks().size()) + 0.5},
                .log_y = true,
                .key = KeyPlace::top_left};
    int colour = 0;
    for (const std::string& engine : engines) {
        Series series{.label = engine, .style = SeriesStyle::line_points, .colour = colour++};
        for (std::size_t t = 0; t < tasks().size(); ++t) {
            const RecordedRun run = read_run(desk.run(tasks()[t].piece(engine)));
            const double per_second = run.cpu_seconds / run.simulated_seconds;
            series.x.push_back(static_cast<double>(t) + 1.0);
            series.y.push_back(per_second);
            table.rows.push_back({tasks()[t].name, engine, fmt::format("{:.3g}", run.time_step),
                                  fmt::format("{:.0f}", run.steps), fmt::format("{:.2f}", run.cpu_seconds),
                                  fmt::format("{:.3g}", per_second),
                                  fmt::format("{:.2f}", 1e6 * run.cpu_seconds / (run.grains * run.steps))});
        }
        panel.series.push_back(std::move(series));
    }
    for (const Task& task : tasks()) panel.x_names.push_back(task.name);
    write_plot({"Section 4.4: what a simulated second costs", {panel}, 1, 900, 600}, desk.stem("efficiency"));
    result.pictures = {{desk.stem("efficiency"), "Cost of the same scenes with the engines of this build"}};
    result.tables = {std::move(table)};

    const bool soft = !at_hand({k_soft}, engines).empty();
    for (const Task& task : tasks()) {
        for (const std::string& engine : at_hand({"contact-1994", "contact"}, engines)) {
            const RecordedRun run = read_run(desk.run(task.piece(engine)));
            const double cost = run.cpu_seconds / run.simulated_seconds;
            result.findings.push_back({engine, task.name + ": processor time per simulated second", cost, 0.0,
                                       task.name == "48 dominoes" ? 120.0 : 7200.0, "s",
                                       "[HN94, sec. 4.4]: several minutes for dominoes, 2 h for a bin, in 1993", ""});
            if (!soft) continue;
            const RecordedRun soft_run = read_run(desk.run(task.piece(k_soft)));
            const double ratio = soft_run.cpu_seconds / soft_run.simulated_seconds / cost;
            result.findings.push_back(
                {engine, task.name + ": processor time of springs and dashpots over this", ratio, 5.0, 20.0, "",
                 "[HN94, sec. 4.4]: about an order of magnitude",
                 ratio < 5.0
                     ? "the refined contacts cost iterations, and soft contacts are cheap where grains are few or round"
                     : "the soft contacts are stiff here, and need short steps"});
        }
    }
    result.paragraphs = {
        "The paper finds the contact model about ten times as fast as springs and dashpots, from a few simple "
        "examples, "
        "without numbers.",
        soft ? "Here the same scenes go through both, on one processor and with the step that each engine takes by "
               "itself (the "
               "contact engines: that of the scenario)."
             : "This build has no engine with springs and dashpots: only the cost of the contact model is given."};
    return result;
}

}  // namespace polargrain
