#include "src/run/time_step.h"

#include <algorithm>
#include <cmath>

#include "src/core/error.h"

namespace polargrain {

TimeStep choose_time_step(const RunSettings& settings, const Engine& engine) {
    const double suggested = engine.suggested_dt();
    if (settings.time_step) return {*settings.time_step, suggested, "given as run.time_step"};
    require(std::isfinite(suggested),
            "run.time_step: \"critical\" has no value here, because nothing can move (no gravity, no initial velocity, "
            "no moving wall, or no grain at all): give run.time_step in seconds, or something to set the grains going");
    std::string origin = fmt::format("critical for {}", engine.name());
    if (settings.time_step_factor != 1.0) origin += fmt::format(", times {}", settings.time_step_factor);
    return {suggested * settings.time_step_factor, suggested, std::move(origin)};
}

std::int64_t step_count(double duration, double dt) {
    const double steps = std::ceil(duration / dt - 1e-6);
    require(steps < 1e15, "run.duration {} s is {} steps of {} s: take a larger time step or a shorter duration",
            duration, duration / dt, dt);
    return static_cast<std::int64_t>(std::max(0.0, steps));
}

}  // namespace polargrain
