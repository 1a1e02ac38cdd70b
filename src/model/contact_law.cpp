#include "src/model/contact_law.h"

#include <cmath>

namespace polargrain {

MaterialIndex material_of(const Scene& scene, BodyIndex body) {
    return is_wall(body) ? scene.walls[static_cast<std::size_t>(wall_index(body))].material
                         : scene.grains.material[Grains::at(body)];
}

const PairLaw& pair_law(const Scene& scene, BodyIndex a, BodyIndex b) {
    return scene.materials.pair(material_of(scene, a), material_of(scene, b));
}

double mean_restitution(const Scene& scene, BodyIndex a, BodyIndex b) {
    if (const auto& own = pair_law(scene, a, b).restitution) return own->mean;
    const double e_b = scene.materials[material_of(scene, b)].restitution.mean;
    if (is_wall(a)) return e_b;
    const double e_a = scene.materials[material_of(scene, a)].restitution.mean;
    const double m_a = scene.grains.mass[Grains::at(a)];
    const double m_b = scene.grains.mass[Grains::at(b)];
    return std::sqrt((m_b * e_a * e_a + m_a * e_b * e_b) / (m_a + m_b));
}

}  // namespace polargrain
