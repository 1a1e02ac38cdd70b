#include "tests/dem/hard_collision.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

Vec2 hard_collision_impulse(const HardCollisionLaw& law, const RoundBody& i, const RoundBody& j, const Vec2& normal,
                            double inertia_ratio) {
    const Vec2 tangent = left_normal(normal);
    const Vec2 relative = i.motion.velocity - j.motion.velocity;
    const double closing = relative.dot(normal);
    if (closing >= 0.0) return Vec2::Zero();
    const double sliding = relative.dot(tangent) - (i.radius * i.motion.spin + j.radius * j.motion.spin);
    const double mass = 1.0 / (1.0 / i.mass + 1.0 / j.mass);
    const double along_normal = -(1.0 + law.restitution) * mass * closing;
    const double wanted = -(1.0 + law.tangential_restitution) * mass * inertia_ratio / (1.0 + inertia_ratio) * sliding;
    const double limit = law.friction * along_normal;
    return along_normal * normal + std::clamp(wanted, -limit, limit) * tangent;
}

Motion after_impulse(const RoundBody& body, const Vec2& impulse, const Vec2& arm, double inertia_ratio) {
    if (!std::isfinite(body.mass)) return body.motion;
    const double inertia = inertia_ratio * body.mass * body.radius * body.radius;
    return {body.motion.velocity + impulse / body.mass, body.motion.spin + cross(arm, impulse) / inertia};
}

}  // namespace polargrain
