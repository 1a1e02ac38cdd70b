#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/model/engine.h"
#include "src/run/progress.h"
#include "src/run/sink.h"

namespace polargrain {

/// Everything about a run in progress beside the engine's own memory: with Engine::save, all that the next step and
/// the next sample depend on.
struct RunState {
    World world;
    Totals totals;
    std::vector<std::int64_t> next_sample;  ///< one per sink: the multiple of its every() that is due next
};

enum class Ending { completed, interrupted };

/// What the sinks are told before the first step. Heights are counted from the lowest point of the scene.
RunInfo describe_run(const Scene& scene, const Engine& engine, double dt, double duration);

/// Adds what one step reported to the sums since time zero.
void add(Totals& totals, const StepReport& report);

/// Whether a simulation with these sinks, as far as they go, can be resumed: what they throw in Sink::check passes
/// through. saved: as Simulation::resume takes it.
void check_sinks(std::span<const std::unique_ptr<Sink>> sinks, const Scene& scene, const Checkpoint& saved);

/// The loop and the clock: takes steps of one size from time zero and hands samples to sinks when they are due.
///
/// Scene, engine and sinks outlive it.
class Simulation {
public:
    Simulation(const Scene& scene, Engine& engine, RunInfo info);

    /// Sinks are served in the order in which they were added.
    void add(Sink& sink) { sinks_.push_back(&sink); }
    /// Makes the engine describe every impact in the reports.
    void record_impacts() { report_.record_impacts = true; }

    /// Runs to the first step at or after the duration, or until stopped; a stop is obeyed between two steps. Either
    /// way the sinks receive a last sample, exactly once, and are ended. What an engine or a sink throws passes
    /// through; samples until then have been handed over.
    ///
    /// control.keep receives a checkpoint before the first step, now and then, and before the last sample: from that
    /// one a longer run goes on as if it had never ended.
    Ending run(const LoopControl& control);

    /// As run, from a checkpoint that a run of the same scene, engine, step and sinks has given: every later bit is
    /// what it would have been. RunError where the checkpoint lacks something.
    Ending resume(const Checkpoint& saved, const LoopControl& control);

    const RunState& state() const { return state_; }

private:
    void begin();
    void load(const Checkpoint& saved);
    Ending loop(const LoopControl& control);
    void keep(const LoopControl& control);
    void step();
    void serve_due_sinks();
    void finish();
    void sample(std::size_t sink);

    const Scene& scene_;
    Engine& engine_;
    RunInfo info_;
    std::vector<Sink*> sinks_;
    RunState state_;
    StepReport report_;
    std::vector<std::int64_t> last_sampled_;  // step of each sink's latest sample
};

}  // namespace polargrain
