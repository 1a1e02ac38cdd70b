#include "src/run/simulation.h"

#include <algorithm>
#include <cmath>

#include "src/core/error.h"
#include "src/run/saved_state.h"
#include "src/run/time_step.h"

namespace polargrain {

namespace {

/// Multiples of `every` that lie at or before the time; a millionth of a step early counts, being round-off.
std::int64_t multiples_until(double time, double every, double dt) {
    return static_cast<std::int64_t>(std::floor((time + 1e-6 * dt) / every));
}

std::string sink_key(std::size_t sink) { return fmt::format("sinks/{}", sink); }

}  // namespace

RunInfo describe_run(const Scene& scene, const Engine& engine, double dt, double duration) {
    RunInfo info;
    info.engine = engine.name();
    info.dt = dt;
    info.duration = duration;
    info.initial = energy(scene.grains, scene.gravity);
    info.lowest = largest_drop(scene).lowest;
    return info;
}

void add(Totals& totals, const StepReport& report) {
    totals.ledger += report.ledger;
    totals.moves += report.moves;
    totals.impacts += report.impacts;
    totals.steps += 1;
    totals.contact_sum += static_cast<std::int64_t>(report.contacts.size());
    totals.deepest = std::max(totals.deepest, report.deepest);
}

void check_sinks(std::span<const std::unique_ptr<Sink>> sinks, const Scene& scene, const Checkpoint& saved) {
    for (std::size_t k = 0; k < sinks.size(); ++k) sinks[k]->check(scene, saved.part(sink_key(k)));
}

Simulation::Simulation(const Scene& scene, Engine& engine, RunInfo info)
    : scene_(scene), engine_(engine), info_(std::move(info)) {
    state_.world = initial_world(scene);
    report_.clear(scene.walls.size());
}

Ending Simulation::run(const LoopControl& control) {
    begin();
    return loop(control);
}

Ending Simulation::resume(const Checkpoint& saved, const LoopControl& control) {
    load(saved);
    return loop(control);
}

Ending Simulation::loop(const LoopControl& control) {
    const std::int64_t steps = step_count(info_.duration, info_.dt);
    keep(control);
    CheckpointClock checkpoints(control);
    ProgressMeter meter(control, state_.world.step, steps, info_.dt);
    while (state_.world.step < steps && !control.stop_requested()) {
        step();
        serve_due_sinks();
        if (checkpoints.due()) {
            keep(control);
            checkpoints.kept();
        }
        meter.after_step(state_.world.step);
    }
    keep(control);
    finish();
    return state_.world.step < steps ? Ending::interrupted : Ending::completed;
}

void Simulation::keep(const LoopControl& control) {
    if (!control.keep) return;
    Checkpoint motion, totals, report, engine, all;
    save_motion(motion, state_.world.grains);
    save(totals, state_.totals);
    save(report, report_);
    engine_.save(engine);
    all.put("step", std::vector{state_.world.step});
    all.put("next_sample", state_.next_sample);
    all.put("last_sampled", last_sampled_);
    all.put_part("motion", motion);
    all.put_part("totals", totals);
    all.put_part("report", report);
    all.put_part("engine", engine);
    for (std::size_t k = 0; k < sinks_.size(); ++k) {
        Checkpoint sink;
        sinks_[k]->save(sink);
        all.put_part(sink_key(k), sink);
    }
    control.keep(all);
}

void Simulation::load(const Checkpoint& saved) {
    state_.world.step = saved.integers("step").at(0);
    state_.world.time = static_cast<double>(state_.world.step) * info_.dt;
    state_.next_sample = saved.integers("next_sample");
    last_sampled_ = saved.integers("last_sampled");
    if (state_.next_sample.size() != sinks_.size() || last_sampled_.size() != sinks_.size()) {
        throw RunError(fmt::format("the checkpoint is of a run with {} outputs, this one has {}",
                                   state_.next_sample.size(), sinks_.size()));
    }
    load_motion(saved.part("motion"), state_.world.grains);
    polargrain::load(saved.part("totals"), state_.totals);
    polargrain::load(saved.part("report"), report_);
    engine_.load(saved.part("engine"));
    for (std::size_t k = 0; k < sinks_.size(); ++k) sinks_[k]->resume(scene_, info_, saved.part(sink_key(k)));
}

void Simulation::begin() {
    state_.next_sample.assign(sinks_.size(), 1);
    last_sampled_.assign(sinks_.size(), -1);
    for (Sink* sink : sinks_) sink->begin(scene_, info_);
    for (std::size_t k = 0; k < sinks_.size(); ++k) sample(k);
}

void Simulation::step() {
    engine_.step(state_.world, info_.dt, report_);
    PG_ASSERT(state_.world.time == static_cast<double>(state_.world.step) * info_.dt, "time {} step {} dt {}",
              state_.world.time, state_.world.step, info_.dt);
    polargrain::add(state_.totals, report_);
    for (Sink* sink : sinks_) sink->step(state_.world, info_.dt, report_);
}

void Simulation::serve_due_sinks() {
    for (std::size_t k = 0; k < sinks_.size(); ++k) {
        const double every = sinks_[k]->every();
        if (every <= 0.0) continue;
        const std::int64_t reached = multiples_until(state_.world.time, every, info_.dt);
        if (reached < state_.next_sample[k]) continue;
        state_.next_sample[k] = reached + 1;
        sample(k);
    }
}

void Simulation::finish() {
    for (std::size_t k = 0; k < sinks_.size(); ++k) {
        if (last_sampled_[k] != state_.world.step) sample(k);
    }
    for (Sink* sink : sinks_) sink->end();
}

void Simulation::sample(std::size_t sink) {
    sinks_[sink]->sample({scene_, state_.world, report_, state_.totals});
    last_sampled_[sink] = state_.world.step;
}

}  // namespace polargrain
