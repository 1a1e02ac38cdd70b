#include "src/run/settle.h"

#include <algorithm>
#include <cmath>

#include "src/core/error.h"
#include "src/run/saved_state.h"
#include "src/run/time_step.h"

namespace polargrain {

namespace {

Scene with_still_walls(const Scene& scene) {
    Scene still = scene;
    for (Wall& wall : still.walls) {
        wall.motion = std::monostate{};
        wall.remove_at.reset();
    }
    return still;
}

double largest_outer_radius(const Scene& scene) {
    double largest = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) largest = std::max(largest, outer_radius(scene.shape_of(k)));
    return largest;
}

/// Settling in progress.
struct Settling {
    World world;
    std::int64_t quiet = 0;  // steps in a row below the threshold
};

void keep(const LoopControl& control, const Settling& now, const Engine& engine) {
    if (!control.keep) return;
    Checkpoint motion, memory, all;
    save_motion(motion, now.world.grains);
    engine.save(memory);
    all.put("clock", std::vector<std::int64_t>{now.world.step, now.quiet});
    all.put_part("motion", motion);
    all.put_part("engine", memory);
    control.keep(all);
}

void load(const Checkpoint& saved, double dt, Settling& now, Engine& engine) {
    const auto& clock = saved.integers("clock");
    now.world.step = clock.at(0);
    now.world.time = static_cast<double>(now.world.step) * dt;
    now.quiet = clock.at(1);
    load_motion(saved.part("motion"), now.world.grains);
    engine.load(saved.part("engine"));
}

}  // namespace

double rest_energy(const Scene& scene, const Grains& grains) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    double reference = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        reference += grains.mass[Grains::at(k)] * g * outer_radius(scene.shape_of(k));
    }
    return reference > 0.0 ? energy(grains, scene.gravity).kinetic() / reference : 0.0;
}

Settled settle(const Scene& scene, const SettleSettings& settings, double dt, const EngineFactory& make_engine,
               const LoopControl& control, const Checkpoint* saved) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    require(g > 0.0, "[settle]: nothing comes to rest without gravity: leave the table out, or set run.gravity");
    const Scene still = with_still_walls(scene);
    const std::unique_ptr<Engine> engine = make_engine(still);
    Settling now{initial_world(still), 0};
    if (saved != nullptr) load(*saved, dt, now, *engine);
    StepReport report;
    const std::int64_t steps = step_count(settings.at_most, dt);
    const std::int64_t quiet_needed = step_count(std::sqrt(2.0 * largest_outer_radius(scene) / g), dt);
    keep(control, now, *engine);
    CheckpointClock checkpoints(control);
    ProgressMeter meter(control, now.world.step, steps, dt);
    while (now.world.step < steps && now.quiet < quiet_needed && !control.stop_requested()) {
        engine->step(now.world, dt, report);
        now.quiet = rest_energy(still, now.world.grains) < settings.until_energy ? now.quiet + 1 : 0;
        if (checkpoints.due()) {
            keep(control, now, *engine);
            checkpoints.kept();
        }
        meter.after_step(now.world.step);
    }
    Settled settled;
    engine->save(settled.engine);
    settled.time = now.world.time;
    settled.energy = rest_energy(still, now.world.grains);
    settled.at_rest = now.quiet >= quiet_needed;
    settled.stopped = !settled.at_rest && now.world.step < steps;
    if (settled.stopped) keep(control, now, *engine);
    settled.grains = std::move(now.world.grains);
    return settled;
}

}  // namespace polargrain
