#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <vector>

#include "render/frames_sink.h"
#include "src/cli/commands.h"
#include "src/cli/interrupt.h"
#include "src/cli/prepared_run.h"
#include "src/cli/progress_display.h"
#include "src/cli/run_folder.h"
#include "src/cli/run_report.h"
#include "src/core/build_info.h"
#include "src/core/error.h"
#include "src/observe/snapshots.h"
#include "src/record/impacts_csv.h"
#include "src/record/series_csv.h"
#include "src/record/text_file.h"
#include "src/record/trajectory_h5.h"
#include "src/run/measurements.h"
#include "src/run/settle.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

class Stopwatch {
public:
    RunCost read() const {
        return {static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count()};
    }

private:
    std::clock_t cpu_ = std::clock();
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

std::vector<std::unique_ptr<Sink>> make_sinks(const fs::path& folder, const OutputSettings& output) {
    const BuildInfo& build = build_info();
    std::vector<std::unique_ptr<Sink>> sinks;
    if (output.series_every > 0.0) {
        sinks.push_back(std::make_unique<SeriesCsv>(folder / "series.csv", output.series_every));
    }
    if (output.trajectory_every > 0.0) {
        Provenance provenance;
        provenance.version = build.version;
        provenance.build = build.compiler + "; " + build.flags + "; " + build.libraries;
        sinks.push_back(
            std::make_unique<TrajectoryH5>(folder / "trajectory.h5", output.trajectory_every, std::move(provenance)));
    }
    if (output.impacts) {
        sinks.push_back(std::make_unique<ImpactsCsv>(folder / "impacts.csv", output.series_every));
    }
    if (output.frames.every > 0.0) sinks.push_back(std::make_unique<FramesSink>(folder / "frames", output.frames));
    return sinks;
}

/// Replaces the scene's grains by the settled ones; returns the engine's memory of how they touch.
Checkpoint settle_scene(PreparedRun& run, DisplayMode mode) {
    Scenario& scenario = run.scenario;
    ProgressDisplay display("settling", mode);
    const LoopControl control{&watch_interrupts(), [&](const Progress& progress) { display.show(progress); }};
    Settled settled = settle(
        scenario.scene, *scenario.settle, run.time_step.dt,
        [&run](const Scene& scene) { return run.make_engine(scene); }, control);
    scenario.scene.grains = std::move(settled.grains);
    if (mode != DisplayMode::none) {
        fmt::print("settling: {} after {:.4g} s, kinetic energy per grain {:.2g} m g R_max\n",
                   settled.at_rest ? "at rest" : "not yet at rest", settled.time, settled.energy);
    }
    return std::move(settled.engine);
}

int run_into(const fs::path& folder, PreparedRun& run, const RunRequest& request) {
    Scenario& scenario = run.scenario;
    const double dt = run.time_step.dt;
    const DisplayMode mode = display_mode(request.quiet);
    TextFile resolved(folder / "scenario.toml");
    resolved.write(scenario.resolved_toml);
    resolved.close();

    std::optional<Checkpoint> settled;
    if (scenario.settle) settled = settle_scene(run, mode);
    const std::unique_ptr<Engine> engine = run.make_engine(scenario.scene);
    if (settled) engine->load(*settled);

    RunInfo info = describe_run(scenario.scene, *engine, dt, scenario.run.duration);
    info.title = scenario.title;
    info.source = scenario.source;
    Simulation simulation(scenario.scene, *engine, info);
    const std::vector<std::unique_ptr<Sink>> sinks = make_sinks(folder, scenario.output);
    for (const auto& sink : sinks) simulation.add(*sink);
    Measurements measurements(scenario.expectations, reading_interval(scenario.output, scenario.run.duration));
    simulation.add(measurements);
    if (scenario.output.impacts) simulation.record_impacts();

    const Stopwatch stopwatch;
    Ending ending{};
    {
        ProgressDisplay display("running", mode);
        ending = simulation.run({&watch_interrupts(), [&](const Progress& progress) { display.show(progress); }});
    }
    Summary summary = summarize(scenario, info, simulation.state(), ending, stopwatch.read());
    summary.observables = measurements.values();
    write_summary(folder / "summary.json", summary);
    if (!request.quiet) print_summary(summary, initial_energy(scenario.scene), folder);
    if (ending == Ending::completed) return k_exit_done;
    fmt::print(stderr,
               "interrupted at t = {:.6g} of {:.6g} s; what was computed so far is in {}\n"
               "to repeat the run: {}{}\n",
               summary.simulated_seconds, info.duration, folder.string(), request.command_line,
               request.force ? "" : " --force");
    return k_exit_interrupted;
}

}  // namespace

int run_command(const RunRequest& request) {
    PreparedRun run = prepare_run(request.scenario, request.overrides);
    const fs::path folder = request.folder ? *request.folder : fs::path("out") / run.file.stem();
    check_run_folder(folder, request.force);
    warn_of_large_step(run.time_step);
    if (!request.quiet) print_plan(run.scenario, run.time_step);

    create_run_folder(folder);
    try {
        return run_into(folder, run, request);
    } catch (const InputError& error) {
        discard_run_folder(folder);
        throw InputError(SourceLocation{.file = run.file.string(), .line = 0, .column = 0}, error.what());
    } catch (const std::exception& error) {
        throw RunError(fmt::format("{}\nwhat was written before is in {}; to repeat the run: {}{}", error.what(),
                                   folder.string(), request.command_line, request.force ? "" : " --force"));
    }
}

}  // namespace polargrain
