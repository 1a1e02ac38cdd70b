#include "src/engines/dem/soft_ledger.h"

#include <algorithm>

namespace polargrain {

namespace {

/// The impulse [N s/m] of a wall on a grain at a point [m], with a moment about it [N s].
void account_wall(int wall, const Motion& motion, const Vec2& point, const Vec2& impulse, double moment,
                  StepReport& report) {
    WallImpulse& sum = report.walls[static_cast<std::size_t>(wall)];
    sum.linear -= impulse;
    sum.angular -= cross(point, impulse) + moment;
    report.ledger.wall_work += impulse.dot(motion.velocity + cross(motion.spin, point)) + moment * motion.spin;
}

}  // namespace

void account_rates(const SoftSystem& system, std::span<const double> x, std::span<const double> v, double weight,
                   StepReport& report) {
    for (const SoftContact& c : system.contacts()) {
        const Motion wall = system.wall_motion(c.a);
        const Vec2 relative = SoftSystem::relative_velocity(c, wall, x, v);
        const double dashpot = (c.normal_force - c.elastic_normal) * relative.dot(c.normal) +
                               c.moment * SoftSystem::relative_spin(c, wall, v);
        report.ledger.restitution_loss -= weight * dashpot;
        report.ledger.friction_loss -= weight * c.sliding_force * relative.dot(left_normal(c.normal));
        if (is_wall(c.a)) account_wall(wall_index(c.a), wall, c.point, weight * c.force(), weight * c.moment, report);
    }
}

void account_losses(const SoftSystem& system, StepReport& report) {
    const SoftSystem::Turnover& turnover = system.turnover();
    report.deepest = std::max(report.deepest, turnover.deepest);
    report.ledger.restitution_loss += turnover.hysteresis + turnover.dropped;
    report.impacts += turnover.born;
    const SoftSystem::Balance& balance = system.balance();
    report.ledger.restitution_loss -= balance.spared;
    for (const auto& [wall, point, impulse] : balance.on_walls) {
        account_wall(wall, system.wall_motion(wall_body(wall)), point, impulse, 0.0, report);
    }
}

}  // namespace polargrain
