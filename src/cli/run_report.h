#pragma once

#include <filesystem>

#include "src/model/settings.h"
#include "src/record/summary.h"
#include "src/run/simulation.h"
#include "src/run/time_step.h"

namespace polargrain {

/// What a run has cost.
struct RunCost {
    double cpu_seconds = 0.0;
    double wall_seconds = 0.0;
};

/// What will run, in a few lines: grains, walls, shapes, time step and where it comes from, steps; then what the engine
/// leaves out of it.
void print_plan(const Scenario& scenario, const TimeStep& time_step, const std::vector<std::string>& notes);

/// A warning on standard error where the step is larger than the engine vouches for.
void warn_of_large_step(const TimeStep& time_step);

Summary summarize(const Scenario& scenario, const RunInfo& info, const RunState& state, Ending ending,
                  const RunCost& cost);

/// What a reader of the numbers has to know and only the run could tell, a sentence each: grains that were not at rest
/// at time zero, overlaps that the engine does not count.
std::vector<std::string> findings(const Summary& summary, const Scene& scene);

/// The closing lines of a run: what it took, how honest the method was, and its findings.
void print_summary(const Summary& summary, const std::vector<std::string>& findings, double initial_energy,
                   const std::filesystem::path& folder);

}  // namespace polargrain
