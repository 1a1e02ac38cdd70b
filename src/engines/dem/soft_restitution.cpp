#include "src/engines/dem/soft_restitution.h"

#include <cmath>

#include "src/core/random.h"

namespace polargrain {

namespace {

double draw(const Restitution& law, RandomStream& stream) {
    if (law.stddev == 0.0) return law.mean;
    for (;;) {
        const double e = law.mean + law.stddev * stream.normal();
        if (e >= 0.0 && e <= 1.0) return e;
    }
}

}  // namespace

double drawn_restitution(const Scene& scene, std::int64_t step, BodyIndex a, BodyIndex b) {
    const MaterialIndex of_b = scene.grains.material[Grains::at(b)];
    const MaterialIndex of_a = is_wall(a) ? scene.walls[static_cast<std::size_t>(wall_index(a))].material
                                          : scene.grains.material[Grains::at(a)];
    const auto pair = static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b);
    RandomStream stream(scene.seed, RandomPurpose::restitution, pair, static_cast<std::uint32_t>(step));
    if (const auto& own = scene.materials.pair(of_a, of_b).restitution) return draw(*own, stream);
    if (is_wall(a)) return draw(scene.materials[of_b].restitution, stream);
    const double e_a = draw(scene.materials[of_a].restitution, stream);
    const double e_b = draw(scene.materials[of_b].restitution, stream);
    const double m_a = scene.grains.mass[Grains::at(a)];
    const double m_b = scene.grains.mass[Grains::at(b)];
    return std::sqrt((m_b * e_a * e_a + m_a * e_b * e_b) / (m_a + m_b));
}

}  // namespace polargrain
