#include <fmt/format.h>

#include <cmath>

#include "src/cli/commands.h"
#include "src/cli/engine_table.h"
#include "src/cli/prepared_run.h"
#include "src/cli/progress_display.h"
#include "src/cli/run_report.h"

namespace polargrain {

namespace {

/// Bytes a grain takes in a stored frame: pose, velocity and its share of the contacts.
constexpr double k_bytes_per_grain_frame = 150.0;

double samples(double duration, double every) { return every > 0.0 ? std::floor(duration / every) + 1.0 : 0.0; }

void print_estimate(const Scenario& scenario, double dt, double parts) {
    const double duration = scenario.run.duration;
    const double grains = scenario.scene.grains.size();
    const double settling = scenario.settle ? scenario.settle->at_most : 0.0;
    const double per_grain_step = find_engine(scenario.run.engine).seconds_per_grain_step;
    const double seconds = grains * (duration + settling) / dt * parts * per_grain_step;
    const OutputSettings& output = scenario.output;
    const std::string cut = parts > 1.0 ? fmt::format(", each step cut into {:.0f} parts", parts) : "";
    fmt::print("  estimate   about {} (min:s) of cpu time for the steps, {:.2g} s per grain and step{}\n",
               clock_text(std::ceil(seconds)), per_grain_step * parts, cut);
    fmt::print("  output     {:.0f} pictures, {:.0f} rows in series.csv, about {:.3g} MB in trajectory.h5\n",
               samples(duration, output.frames.every), samples(duration, output.series_every),
               samples(duration, output.trajectory_every) * grains * k_bytes_per_grain_frame * 1e-6);
}

}  // namespace

int check_command(const CheckRequest& request) {
    const PreparedRun run = prepare_run(request.scenario, request.overrides);
    warn_of_large_step(run.time_step);
    print_plan(run.scenario, run.time_step, run.notes);
    const double dt = run.time_step.dt;
    print_estimate(run.scenario, dt, run.make_engine(run.scenario.scene)->parts_of_step(dt));
    return k_exit_done;
}

}  // namespace polargrain
