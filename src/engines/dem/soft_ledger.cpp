#include "src/engines/dem/soft_ledger.h"

#include <algorithm>

namespace polargrain {

void account_rates(SoftSystem& system, std::span<const double> x, std::span<const double> v, double weight,
                   StepReport& report) {
    const auto velocity = [&](BodyIndex grain, const Vec2& point) {
        const std::size_t k = 3 * Grains::at(grain);
        return Vec2(Vec2(v[k], v[k + 1]) + cross(v[k + 2], Vec2(point - Vec2(x[k], x[k + 1]))));
    };
    for (SoftContact& c : system.contacts()) {
        Vec2 of_a = Vec2::Zero();
        if (is_wall(c.a)) {
            const Motion& wall = system.wall_motion(c.a);
            of_a = wall.velocity + cross(wall.spin, c.point);
        } else {
            of_a = velocity(c.a, c.point);
        }
        const Vec2 relative = velocity(c.b, c.point) - of_a;
        report.ledger.restitution_loss -= weight * (c.normal_force - c.elastic_normal) * relative.dot(c.normal);
        report.ledger.friction_loss -= weight * c.sliding_force * relative.dot(left_normal(c.normal));
        const Vec2 impulse = weight * c.force();
        c.impulse += impulse;
        if (!is_wall(c.a)) continue;
        WallImpulse& wall = report.walls[static_cast<std::size_t>(wall_index(c.a))];
        wall.linear -= impulse;
        wall.angular -= cross(c.point, impulse);
        report.ledger.wall_work += impulse.dot(of_a);
    }
}

void account_losses(const SoftSystem& system, StepReport& report) {
    for (const SoftContact& c : system.contacts()) {
        report.ledger.restitution_loss += c.hysteresis;
        report.deepest = std::max(report.deepest, c.depth);
    }
    const SoftSystem::Turnover& turnover = system.turnover();
    report.ledger.restitution_loss += turnover.dropped;
    report.impacts += turnover.born;
}

StoredEnergy stored_energy(const SoftSystem& system) {
    StoredEnergy sum;
    for (const SoftContact& c : system.contacts()) {
        sum.normal += c.stored_normal;
        sum.sliding += c.stored_sliding;
    }
    return sum;
}

}  // namespace polargrain
