#include "src/run/settle.h"

#include <algorithm>
#include <cmath>

#include "src/core/error.h"
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
               const LoopControl& control) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    require(g > 0.0, "[settle]: nothing comes to rest without gravity: leave the table out, or set run.gravity");
    const Scene still = with_still_walls(scene);
    const std::unique_ptr<Engine> engine = make_engine(still);
    World world = initial_world(still);
    StepReport report;
    const std::int64_t steps = step_count(settings.at_most, dt);
    const std::int64_t quiet_needed = step_count(std::sqrt(2.0 * largest_outer_radius(scene) / g), dt);
    std::int64_t quiet = 0;
    ProgressMeter meter(control, steps, dt);
    while (world.step < steps && quiet < quiet_needed && !control.stop_requested()) {
        engine->step(world, dt, report);
        quiet = rest_energy(still, world.grains) < settings.until_energy ? quiet + 1 : 0;
        meter.after_step(world.step);
    }
    Settled settled;
    engine->save(settled.engine);
    settled.time = world.time;
    settled.energy = rest_energy(still, world.grains);
    settled.at_rest = quiet >= quiet_needed;
    settled.grains = std::move(world.grains);
    return settled;
}

}  // namespace polargrain
