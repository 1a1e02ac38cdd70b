#include "src/cli/run_report.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "src/cli/messages.h"
#include "src/core/build_info.h"
#include "src/observe/bed.h"

namespace polargrain {

namespace {

/// Overlaps that differ by less of the mean outer radius are not worth a note.
constexpr double k_worth_telling = 0.01;

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

}  // namespace

void print_plan(const Scenario& scenario, const TimeStep& time_step, const std::vector<std::string>& notes) {
    const Scene& scene = scenario.scene;
    int pieces = 0;
    for (const Wall& wall : scene.walls) pieces += wall.segments();
    fmt::print("{}\n", scenario.title);
    fmt::print("  engine     {}\n", scenario.run.engine);
    fmt::print("  grains     {} of {} shapes\n", scene.grains.size(), scene.shapes.size());
    fmt::print("  walls      {} of {} pieces in all\n", scene.walls.size(), pieces);
    fmt::print("  time step  {:.6g} s ({})\n", time_step.dt, time_step.origin);
    if (scenario.settle) fmt::print("  settling   {:.4g} s at most, before time zero\n", scenario.settle->at_most);
    fmt::print("  duration   {:.6g} s, {} steps\n", scenario.run.duration,
               step_count(scenario.run.duration, time_step.dt));
    for (const std::string& note : notes) fmt::print("  note       {}\n", note);
}

void warn_of_large_step(const TimeStep& time_step) {
    if (!time_step.too_large()) return;
    tell(
        "warning: run.time_step = {:.4g} s is {:.3g} times the critical step ({:.4g} s): grains may pass one "
        "another unseen\n",
        time_step.dt, time_step.dt / time_step.suggested, time_step.suggested);
}

Summary summarize(const Scenario& scenario, const RunInfo& info, const RunState& state, Ending ending,
                  const RunCost& cost) {
    Summary summary;
    summary.title = scenario.title;
    summary.source = scenario.source;
    summary.engine = info.engine;
    summary.version = build_info().version;
    summary.build_flags = build_info().compiler + " " + build_info().flags;
    summary.seed = scenario.scene.seed;
    summary.threads = scenario.scene.threads;
    summary.completed = ending == Ending::completed;
    summary.steps = state.world.step;
    summary.time_step = info.dt;
    summary.simulated_seconds = state.world.time;
    summary.cpu_seconds = cost.cpu_seconds;
    summary.wall_seconds = cost.wall_seconds;
    summary.grains = state.world.grains.size();
    summary.grains_out = count_out(scenario.scene, state.world.grains);
    summary.totals = state.totals;
    summary.initial = info.initial;
    summary.final_energy = energy(state.world.grains, scenario.scene.gravity);
    summary.state_hash = state_hash(state.world);
    return summary;
}

std::vector<std::string> findings(const Summary& summary, const Scene& scene) {
    std::vector<std::string> found;
    if (const auto& settling = summary.settling; settling && !settling->at_rest) {
        found.push_back(fmt::format(
            "the grains were not yet at rest at time zero: after settle.at_most = {:.4g} s their kinetic energy was "
            "{:.2g} m g R_max per grain, and settle.until_energy asks for {:.2g}",
            settling->at_most, settling->energy, settling->until_energy));
    }
    const auto measured = summary.observables.find("deepest_overlap");
    if (measured != summary.observables.end() &&
        measured->second - summary.totals.deepest > k_worth_telling * mean_outer_radius(scene)) {
        found.push_back(fmt::format(
            "overlaps of up to {:.3g} m were measured on the outlines, and the engine tells of {:.3g} m: go by "
            "observables.deepest_overlap, not by deepest_overlap",
            measured->second, summary.totals.deepest));
    }
    return found;
}

void print_summary(const Summary& summary, const std::vector<std::string>& findings, double initial_energy,
                   const std::filesystem::path& folder) {
    const Totals& totals = summary.totals;
    const auto steps = static_cast<double>(summary.steps);
    fmt::print("{} grains, {} steps of {:.4g} s to t = {:.4g} s\n", summary.grains, summary.steps, summary.time_step,
               summary.simulated_seconds);
    fmt::print("  cpu time         {:.3g} s, {:.3g} s per simulated second\n", summary.cpu_seconds,
               ratio(summary.cpu_seconds, summary.simulated_seconds));
    fmt::print("  mean contacts    {:.4g}\n", ratio(static_cast<double>(totals.contact_sum), steps));
    fmt::print("  moves rejected   {:.3g} % of {} tried\n",
               100.0 * ratio(static_cast<double>(totals.moves.rejected), static_cast<double>(totals.moves.tried)),
               totals.moves.tried);
    fmt::print("  energy created   {:.3g} of E0 = {:.4g} J/m (sum of rises)\n",
               ratio(totals.ledger.rises, initial_energy), initial_energy);
    fmt::print("  deepest overlap  {:.3g} m\n", totals.deepest);
    for (const std::string& finding : findings) fmt::print("  note             {}\n", finding);
    if (summary.grains_out > 0) fmt::print("  grains out       {}\n", summary.grains_out);
    fmt::print("  state hash       {}\n", summary.state_hash);
    fmt::print("  run folder       {}\n", folder.string());
}

}  // namespace polargrain
