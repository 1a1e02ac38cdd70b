#include "src/engines/contact/energy_guard.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

double kinetic_energy(const SolverBody& body) {
    return 0.5 * (body.velocity.squaredNorm() / body.inverse_mass + body.spin * body.spin / body.inverse_inertia);
}

double total_energy(const std::vector<SolverBody>& bodies, const PoseSet& poses, const Vec2& gravity) {
    double sum = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        sum += kinetic_energy(bodies[k]) - gravity.dot(poses.centre[k]) / bodies[k].inverse_mass;
    }
    return sum;
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
