#pragma once

#include <optional>
#include <vector>

#include "src/engines/contact/push_system.h"

namespace polargrain {

/// Of gravity's kick: a bed that gets no faster is held, but for round-off.
inline constexpr double k_held = 1e-6;

/// Impulses of all lasting contacts of a sub-step, found together, where sweeps over them one by one do not settle.
///
/// Of all velocities v for which no gap closes beyond its resting gap, a bed takes those with the least
/// sum (v - w).M (v - w) / 2, where w are the velocities that it would have without contacts (Gauss's principle of
/// least constraint). The impulses are the multipliers of the gaps. Those of the last time, as a rule, say which
/// contacts push (solve_active); where too much has changed, an interior point method begins from nothing
/// (solve_interior).
///
/// A contact with friction pushes along both edges of its cone in place of its normal. What slides would then open its
/// gap, so where grains move on contacts with friction there is no answer.
///
/// Returns the impulse of each contact on its first body, (normal, tangential) [N s/m].
std::optional<std::vector<Vec2>> find_equilibrium(const SlowBed& bed);

}  // namespace polargrain
