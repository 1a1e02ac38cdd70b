#include "src/engines/contact/energy_guard.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

double kinetic_energy(const SolverBody& body) {
    return 0.5 * (body.velocity.squaredNorm() / body.inverse_mass + body.spin * body.spin / body.inverse_inertia);
}

double total_energy(const std::vector<SolverBody>& bodies, const PoseSet& poses, const Vec2& gravity,
                    const Parallel& parallel) {
    constexpr std::size_t k_run = 1024;
    return parallel.sum(bodies.size(), k_run, [&](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t k = first; k < last; ++k) {
            sum += kinetic_energy(bodies[k]) - gravity.dot(poses.centre[k]) / bodies[k].inverse_mass;
        }
        return sum;
    });
}

double guard_energy(std::vector<SolverBody>& bodies, double excess) {
    if (excess <= 0.0) return 0.0;
    double available = 0.0;
    for (const SolverBody& body : bodies) {
        if (body.touched) available += kinetic_energy(body);
    }
    if (available <= 0.0) return 0.0;
    const double taken = std::min(excess, available);
    const double scale = std::sqrt(std::max(0.0, 1.0 - taken / available));
    for (SolverBody& body : bodies) {
        if (!body.touched) continue;
        body.velocity *= scale;
        body.spin *= scale;
    }
    return taken;
}

}  // namespace polargrain
