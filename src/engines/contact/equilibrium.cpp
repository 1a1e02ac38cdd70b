#include "src/engines/contact/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/active_pushes.h"
#include "src/engines/contact/interior_point.h"

namespace polargrain {

std::optional<std::vector<Vec2>> find_equilibrium(const SlowBed& bed) {
    PushSystem system(bed);
    std::optional<PushSolution> solution = solve_active(system);
    if (!solution) solution = solve_interior(system);
    if (!solution) return {};
    const bool rough =
        std::any_of(bed.contacts.begin(), bed.contacts.end(), [](const GapContact& c) { return c.friction > 0.0; });
    const auto moves = [](double v) { return std::abs(v) > k_held; };
    if (rough && std::any_of(solution->speeds.begin(), solution->speeds.end(), moves)) return {};
    return system.contact_impulses(solution->impulses);
}

}  // namespace polargrain
