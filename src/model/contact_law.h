#pragma once

#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// Material of a grain or a wall.
MaterialIndex material_of(const Scene& scene, BodyIndex body);

/// What two bodies do to one another.
const PairLaw& pair_law(const Scene& scene, BodyIndex a, BodyIndex b);

/// Coefficient of restitution of two bodies a < b without its scatter: the mean of the pair's own law if it has one; of
/// two grains combined by mass, e^2 = (m_b e_a^2 + m_a e_b^2) / (m_a + m_b) [HN94, eq. 46]; against a wall the grain's
/// own.
double mean_restitution(const Scene& scene, BodyIndex a, BodyIndex b);

}  // namespace polargrain
