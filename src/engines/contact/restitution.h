#pragma once

#include <cstdint>

#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// Coefficient of restitution of an impact between bodies a < b in a step of a run.
///
/// Each body's coefficient is drawn from its material's normal distribution, anew where a sample leaves [0, 1], by a
/// counter-based generator keyed by (seed, step, pair): the draw depends neither on threads nor on the order in which
/// impacts are processed; a standard deviation of zero draws nothing. Two grains: e^2 = (m_b e_a^2 + m_a e_b^2) /
/// (m_a + m_b) [HN94, eq. 46]; against a wall the grain's own. A pair that has its own restitution in the scenario
/// draws from that instead.
double impact_restitution(const Scene& scene, std::int64_t step, BodyIndex a, BodyIndex b);

/// Coulomb's coefficient between the materials of two bodies.
double pair_friction(const Scene& scene, BodyIndex a, BodyIndex b);

}  // namespace polargrain
