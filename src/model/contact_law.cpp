#include "src/model/contact_law.h"

#include <cmath>
#include <optional>

#include "src/core/random.h"

namespace polargrain {

namespace {

/// Draws from one stream per (step, pair), made only when something is to be drawn.
class Draw {
public:
    Draw(const Scene& scene, std::int64_t step, BodyIndex a, BodyIndex b)
        : seed_(scene.seed),
          pair_(static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b)),
          step_(static_cast<std::uint32_t>(step)) {}

    double operator()(const Restitution& law) {
        if (law.stddev == 0.0) return law.mean;
        if (!stream_) stream_.emplace(seed_, RandomPurpose::restitution, pair_, step_);
        for (;;) {
            const double e = law.mean + law.stddev * stream_->normal();
            if (e >= 0.0 && e <= 1.0) return e;
        }
    }

private:
    std::uint64_t seed_;
    std::uint64_t pair_;
    std::uint32_t step_;
    std::optional<RandomStream> stream_;
};

/// [HN94, eq. 46]; value_of gives the number that a material's or a pair's law stands for.
template <typename ValueOf>
double combined_restitution(const Scene& scene, BodyIndex a, BodyIndex b, ValueOf value_of) {
    const MaterialIndex of_a = material_of(scene, a);
    const MaterialIndex of_b = material_of(scene, b);
    if (const auto& own = scene.materials.pair(of_a, of_b).restitution) return value_of(*own);
    if (is_wall(a)) return value_of(scene.materials[of_b].restitution);
    const double e_a = value_of(scene.materials[of_a].restitution);
    const double e_b = value_of(scene.materials[of_b].restitution);
    const double m_a = scene.grains.mass[Grains::at(a)];
    const double m_b = scene.grains.mass[Grains::at(b)];
    return std::sqrt((m_b * e_a * e_a + m_a * e_b * e_b) / (m_a + m_b));
}

}  // namespace

MaterialIndex material_of(const Scene& scene, BodyIndex body) {
    return is_wall(body) ? scene.walls[static_cast<std::size_t>(wall_index(body))].material
                         : scene.grains.material[Grains::at(body)];
}

const PairLaw& pair_law(const Scene& scene, BodyIndex a, BodyIndex b) {
    return scene.materials.pair(material_of(scene, a), material_of(scene, b));
}

double mean_restitution(const Scene& scene, BodyIndex a, BodyIndex b) {
    return combined_restitution(scene, a, b, [](const Restitution& law) { return law.mean; });
}

double drawn_restitution(const Scene& scene, std::int64_t step, BodyIndex a, BodyIndex b) {
    return combined_restitution(scene, a, b, Draw(scene, step, a, b));
}

}  // namespace polargrain
