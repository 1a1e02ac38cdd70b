#include "src/compare/jitter.h"

#include <cmath>

#include "src/core/random.h"
#include "src/observe/bed.h"

namespace polargrain {

void add_jitter(Scene& scene) {
    const double g = std::sqrt(scene.gravity.squaredNorm());
    const double speed = g > 0.0 ? std::sqrt(g * mean_outer_radius(scene)) : largest_speed(scene);
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        RandomStream random(scene.seed, RandomPurpose::jitter, static_cast<std::uint64_t>(k));
        const double x = random.normal();
        const double y = random.normal();
        scene.grains.set_velocity(k, scene.grains.velocity(k) + k_jitter * speed * Vec2(x, y));
    }
}

}  // namespace polargrain
