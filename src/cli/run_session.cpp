#include "src/cli/run_session.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "render/frames_sink.h"
#include "src/cli/commands.h"
#include "src/cli/interrupt.h"
#include "src/cli/messages.h"
#include "src/cli/progress_display.h"
#include "src/cli/run_report.h"
#include "src/cli/shell_words.h"
#include "src/core/build_info.h"
#include "src/core/error.h"
#include "src/core/hash.h"
#include "src/observe/snapshots.h"
#include "src/record/impacts_csv.h"
#include "src/record/series_csv.h"
#include "src/record/text_file.h"
#include "src/record/trajectory_h5.h"
#include "src/run/measurements.h"
#include "src/run/saved_state.h"
#include "src/run/settle.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

// Where the parts of a run stand in its checkpoint.
constexpr const char* k_time_step = "time_step";
constexpr const char* k_cost = "cost";
constexpr const char* k_settling = "settling";  // the grains come to rest before time zero
constexpr const char* k_settled = "settled";    // what that led to: time, energy, whether at rest
constexpr const char* k_start = "start";        // motion of the grains at time zero
constexpr const char* k_running = "running";
constexpr const char* k_outcome = "outcome";  // in `settled`

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

bool holds(const Checkpoint& checkpoint, const std::string& part) {
    return !checkpoint.part(part).all_reals().empty() || !checkpoint.part(part).all_integers().empty();
}

CheckpointLabel label_of(const PreparedRun& run) {
    const BuildInfo& build = build_info();
    return {build.version, build.compiler + "; " + build.flags + "; " + build.libraries, run.scenario.run.engine,
            scenario_fingerprint(run.scenario.resolved_toml)};
}

void check_fit(const RunSession& session, const PreparedRun& run, const LabelledCheckpoint& saved) {
    const std::string file = session.checkpoint_file().string();
    const CheckpointLabel now = label_of(run);
    require(saved.label.scenario == now.scenario,
            "{}: was made with another {}, which has been changed since; bring the old one back, or run the new one "
            "from its beginning with --force",
            file, session.scenario_file().string());
    const double dt = saved.content.reals(k_time_step).at(0);
    require(dt == run.time_step.dt,
            "{}: was made with a time step of {} s, and this build finds {} s critical; resume with the version that "
            "began the run, {}",
            file, dt, run.time_step.dt, saved.label.version);
    if (saved.label.version == now.version && saved.label.build == now.build) return;
    tell(
        "warning: the run was begun by another build ({} {}); where that computes other bits, the result is "
        "neither its own nor this one's\n",
        saved.label.version, saved.label.build);
}

/// One run on its way: what its stages share.
class Session {
public:
    Session(const RunSession& session, PreparedRun& run, const LabelledCheckpoint* saved)
        : session_(session),
          run_(run),
          saved_(saved),
          label_(saved != nullptr ? saved->label : label_of(run)),
          mode_(display_mode(session.quiet)) {
        if (saved == nullptr || !holds(saved->content, k_running)) return;
        const auto& cost = saved->content.reals(k_cost);
        spent_ = {cost.at(0), cost.at(1)};
        if (holds(saved->content, k_settled)) {
            const std::vector<double> settled = saved->content.part(k_settled).reals(k_outcome);
            settling_ = settling_summary(settled.at(0), settled.at(1), settled.at(2) != 0.0);
        }
    }

    int carry_out();

private:
    void begin_folder() const;
    bool let_settle();
    SettlingSummary settling_summary(double seconds, double energy, bool at_rest) const;
    std::vector<std::unique_ptr<Sink>> make_sinks() const;
    Ending simulate(Simulation& simulation);
    LoopControl control(ProgressDisplay& display, const char* part);
    void keep(const char* part, const Checkpoint& content);
    RunCost cost() const;
    int report_interrupt(const std::string& where) const;

    const RunSession& session_;
    PreparedRun& run_;
    const LabelledCheckpoint* saved_;
    CheckpointLabel label_;
    DisplayMode mode_;
    std::optional<Checkpoint> settled_;  // the engine's memory of how the settled grains touch
    std::optional<SettlingSummary> settling_;
    Checkpoint start_;
    RunCost spent_;  // before this program
    Stopwatch stopwatch_;
};

int Session::carry_out() {
    Scenario& scenario = run_.scenario;
    const bool running = saved_ != nullptr && holds(saved_->content, k_running);
    const std::vector<std::unique_ptr<Sink>> sinks = make_sinks();
    // Whatever could refuse to be carried on does so before anything in the folder is changed.
    if (running) check_sinks(sinks, scenario.scene, saved_->content.part(k_running));
    if (!session_.quiet && !session_.opening_line.empty()) fmt::print("{}\n", session_.opening_line);
    begin_folder();
    if (running) {
        load_motion(saved_->content.part(k_start), scenario.scene.grains);
    } else if (scenario.settle && !let_settle()) {
        return report_interrupt("while the grains were settling");
    }
    save_motion(start_, scenario.scene.grains);
    const std::unique_ptr<Engine> engine = run_.make_engine(scenario.scene);
    if (settled_) engine->load(*settled_);

    RunInfo info = describe_run(scenario.scene, *engine, run_.time_step.dt, scenario.run.duration);
    info.title = scenario.title;
    info.source = scenario.source;
    Simulation simulation(scenario.scene, *engine, info);
    for (const auto& sink : sinks) simulation.add(*sink);
    Measurements measurements(scenario.expectations, reading_interval(scenario.output, scenario.run.duration));
    simulation.add(measurements);
    if (scenario.output.impacts) simulation.record_impacts();

    stopwatch_ = Stopwatch();
    const Ending ending = simulate(simulation);
    Summary summary = summarize(scenario, info, simulation.state(), ending, cost());
    summary.observables = measurements.values();
    summary.settling = settling_;
    summary.notes = run_.notes;
    const std::vector<std::string> found = findings(summary, scenario.scene);
    summary.notes.insert(summary.notes.end(), found.begin(), found.end());
    write_summary(session_.folder / "summary.json", summary);
    if (!session_.quiet && !session_.brief) {
        print_summary(summary, found, initial_energy(scenario.scene), session_.folder);
    }
    if (ending == Ending::completed) return k_exit_done;
    return report_interrupt(fmt::format("at t = {:.6g} of {:.6g} s", summary.simulated_seconds, info.duration));
}

/// A folder with a summary has been brought to an end: from here on this one has not.
void Session::begin_folder() const {
    std::error_code ignored;
    fs::remove(session_.folder / "summary.json", ignored);
    write_whole_file(session_.scenario_file(), run_.scenario.resolved_toml);
}

/// Replaces the scene's grains by the settled ones. False where it was stopped.
bool Session::let_settle() {
    Scenario& scenario = run_.scenario;
    std::optional<Checkpoint> before;
    if (saved_ != nullptr) before = saved_->content.part(k_settling);
    const auto shown = [&] {  // what follows is printed when its progress has been erased
        ProgressDisplay display("settling", mode_);
        return settle(
            scenario.scene, *scenario.settle, run_.time_step.dt,
            [this](const Scene& scene) { return run_.make_engine(scene); }, control(display, k_settling),
            before ? &*before : nullptr);
    };
    Settled settled = shown();
    if (settled.stopped) return false;
    settling_ = settling_summary(settled.time, settled.energy, settled.at_rest);
    scenario.scene.grains = std::move(settled.grains);
    settled_ = std::move(settled.engine);
    if (mode_ != DisplayMode::none) {
        fmt::print("settling: {} after {:.4g} s, kinetic energy per grain {:.2g} m g R_max\n",
                   settled.at_rest ? "at rest" : "not yet at rest", settled.time, settled.energy);
    }
    return true;
}

SettlingSummary Session::settling_summary(double seconds, double energy, bool at_rest) const {
    const SettleSettings& asked = run_.scenario.settle.value();
    return {at_rest, seconds, asked.at_most, energy, asked.until_energy};
}

std::vector<std::unique_ptr<Sink>> Session::make_sinks() const {
    const fs::path& folder = session_.folder;
    const OutputSettings& output = run_.scenario.output;
    std::vector<std::unique_ptr<Sink>> sinks;
    if (output.series_every > 0.0) {
        sinks.push_back(std::make_unique<SeriesCsv>(folder / "series.csv", output.series_every, output.observe));
    }
    if (output.trajectory_every > 0.0) {
        Provenance provenance;
        provenance.version = label_.version;
        provenance.build = label_.build;
        sinks.push_back(
            std::make_unique<TrajectoryH5>(folder / "trajectory.h5", output.trajectory_every, std::move(provenance)));
    }
    if (output.impacts) {
        sinks.push_back(std::make_unique<ImpactsCsv>(folder / "impacts.csv", output.series_every));
    }
    if (output.frames.every > 0.0) sinks.push_back(std::make_unique<FramesSink>(folder / "frames", output.frames));
    return sinks;
}

Ending Session::simulate(Simulation& simulation) {
    ProgressDisplay display("running", mode_);
    const LoopControl loop = control(display, k_running);
    if (saved_ == nullptr || !holds(saved_->content, k_running)) return simulation.run(loop);
    return simulation.resume(saved_->content.part(k_running), loop);
}

LoopControl Session::control(ProgressDisplay& display, const char* part) {
    return {.stop = &watch_interrupts(),
            .progress = [&display](const Progress& progress) { display.show(progress); },
            .keep = [this, part](const Checkpoint& content) { keep(part, content); },
            .keep_every = run_.scenario.output.checkpoint_every_wall};
}

void Session::keep(const char* part, const Checkpoint& content) {
    LabelledCheckpoint all{label_, {}};
    const RunCost so_far = cost();
    all.content.put(k_time_step, std::vector{run_.time_step.dt});
    all.content.put(k_cost, std::vector{so_far.cpu_seconds, so_far.wall_seconds});
    if (std::string_view(part) == k_running) {
        all.content.put_part(k_start, start_);
        if (settling_) {
            Checkpoint settled;
            settled.put(k_outcome, std::vector{settling_->seconds, settling_->energy, settling_->at_rest ? 1.0 : 0.0});
            all.content.put_part(k_settled, settled);
        }
    }
    all.content.put_part(part, content);
    write_checkpoint(session_.checkpoint_file(), all);
}

RunCost Session::cost() const {
    const RunCost now = stopwatch_.read();
    return {spent_.cpu_seconds + now.cpu_seconds, spent_.wall_seconds + now.wall_seconds};
}

int Session::report_interrupt(const std::string& where) const {
    tell("interrupted {}; {}{}\n", where,
         session_.repeat_line.empty()
             ? fmt::format("a checkpoint has been written, and what was computed so far is in {}\n",
                           session_.folder.string())
             : "",
         session_.way_on());
    return k_exit_interrupted;
}

}  // namespace

std::string RunSession::way_on() const {
    if (!repeat_line.empty()) return "to do it again from the beginning: " + repeat_line;
    return "to carry the run on from its last checkpoint: " + shell_quoted(program) + " resume " +
           shell_quoted(folder.string());
}

std::string scenario_fingerprint(const std::string& resolved_toml) {
    const std::size_t run = resolved_toml.find("\n[run]\n");
    const std::size_t line = resolved_toml.find("\nduration = ", run);
    const std::size_t end = resolved_toml.find('\n', line + 1);
    StateHash hash;
    hash.add(std::string_view(resolved_toml).substr(0, line));
    if (end != std::string::npos) hash.add(std::string_view(resolved_toml).substr(end));
    return hash.hex();
}

double time_reached(const LabelledCheckpoint& saved) {
    const Checkpoint running = saved.content.part(k_running);
    if (running.all_integers().empty()) return -1.0;
    return static_cast<double>(running.integers("step").at(0)) * saved.content.reals(k_time_step).at(0);
}

int run_session(const RunSession& session, const FolderLock& /*lock*/, PreparedRun& run,
                const LabelledCheckpoint* saved) {
    watch_interrupts();  // from the moment there is something to resume
    if (saved != nullptr) check_fit(session, run, *saved);
    return Session(session, run, saved).carry_out();
}

}  // namespace polargrain
