#pragma once

#include <cstdint>

#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// Material of a grain or a wall.
MaterialIndex material_of(const Scene& scene, BodyIndex body);

/// What two bodies do to one another.
const PairLaw& pair_law(const Scene& scene, BodyIndex a, BodyIndex b);

/// Coefficient of restitution of two bodies a < b without its scatter: that of the pair's own law if it has one; of two
/// grains combined by mass, e^2 = (m_b e_a^2 + m_a e_b^2) / (m_a + m_b) [HN94, eq. 46]; against a wall the grain's own.
double mean_restitution(const Scene& scene, BodyIndex a, BodyIndex b);

/// The same with its scatter, for a contact of bodies a < b in a step of a run.
///
/// Each coefficient is drawn from its normal distribution, anew where a sample leaves [0, 1], by a counter-based
/// generator keyed by (seed, step, pair): the draw depends neither on threads nor on the order in which contacts are
/// processed; a standard deviation of zero draws nothing.
double drawn_restitution(const Scene& scene, std::int64_t step, BodyIndex a, BodyIndex b);

}  // namespace polargrain
