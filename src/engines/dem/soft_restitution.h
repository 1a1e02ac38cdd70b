#pragma once

#include "src/model/contact.h"
#include "src/model/scene.h"

namespace polargrain {

/// Coefficient of restitution of a contact that bodies a < b begin in a step of a run.
///
/// Two grains: e^2 = (m_b e_a^2 + m_a e_b^2) / (m_a + m_b) [HN94, eq. 46]; against a wall the grain's own; a pair that
/// has its own restitution in the scenario has that. Each is drawn from its normal distribution, truncated to [0, 1],
/// by numbers keyed to (seed, step, pair).
double drawn_restitution(const Scene& scene, std::int64_t step, BodyIndex a, BodyIndex b);

}  // namespace polargrain
