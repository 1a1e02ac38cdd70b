#include "src/engines/box2d/step_account.h"

#include <algorithm>

namespace polargrain {

namespace {

/// Velocity of a grain's material at an arm from its centre.
Vec2 velocity_at(const Vec2& velocity, double spin, const Vec2& arm) { return velocity + cross(spin, arm); }

class Account {
public:
    Account(const Scene& scene, const BoxWorld& box, const MotionState& before, const Grains& after, double dt)
        : scene_(scene), box_(box), before_(before), after_(after), dt_(dt) {}

    void add(const PointImpulse& p, StepReport& report) const {
        const Vec2 mean = mean_velocity(p.b, p.point_before) - mean_velocity(p.a, p.point_before);
        const Vec2 tangent(p.normal_before.y(), -p.normal_before.x());
        report.ledger.restitution_loss -= p.along_normal * p.normal_before.dot(mean);
        report.ledger.friction_loss -= p.along_tangent * tangent.dot(mean);
        report.contacts.push_back({p.a, p.b, p.point, p.normal, p.gap, p.impulse()});
        report.deepest = std::max(report.deepest, -p.gap);
        ++report.impacts;
        if (is_wall(p.a)) add_to_wall(p, report);
    }

    double correction() const {
        double sum = 0.0;
        for (std::size_t k = 0; k < after_.x.size(); ++k) {
            const Vec2 shift(after_.x[k] - before_.x[k] - dt_ * after_.vx[k],
                             after_.y[k] - before_.y[k] - dt_ * after_.vy[k]);
            sum -= after_.mass[k] * scene_.gravity.dot(shift);
        }
        return sum;
    }

    double energy_before() const {
        Grains grains = after_;
        before_.put(grains);
        return energy(grains, scene_.gravity).total();
    }

private:
    /// Mean of before and after.
    Vec2 mean_velocity(BodyIndex body, const Vec2& point) const {
        if (is_wall(body)) return box_.wall_velocity(wall_index(body), point);
        const std::size_t k = Grains::at(body);
        const Vec2 arm(point.x() - before_.x[k], point.y() - before_.y[k]);
        return 0.5 * (velocity_at({before_.vx[k], before_.vy[k]}, before_.spin[k], arm) +
                      velocity_at({after_.vx[k], after_.vy[k]}, after_.spin[k], arm));
    }

    void add_to_wall(const PointImpulse& p, StepReport& report) const {
        WallImpulse& wall = report.walls[static_cast<std::size_t>(wall_index(p.a))];
        const Vec2 impulse = p.impulse();
        wall.linear -= impulse;
        wall.angular -= cross(p.point_before, impulse);
        report.ledger.wall_work += impulse.dot(mean_velocity(p.a, p.point_before));
    }

    const Scene& scene_;
    const BoxWorld& box_;
    const MotionState& before_;
    const Grains& after_;
    double dt_;
};

}  // namespace

void account(const Scene& scene, const BoxWorld& box, const MotionState& before, const Grains& after, double dt,
             StepReport& report) {
    const Account sums(scene, box, before, after, dt);
    for (const PointImpulse& p : box.impulses()) sums.add(p, report);
    std::stable_sort(report.contacts.begin(), report.contacts.end(),
                     [](const Contact& p, const Contact& q) { return p.a < q.a || (p.a == q.a && p.b < q.b); });
    EnergyLedger& ledger = report.ledger;
    ledger.correction = sums.correction();
    const double gained = energy(after, scene.gravity).total() - sums.energy_before() - ledger.wall_work;
    ledger.created = gained - ledger.correction + ledger.restitution_loss + ledger.friction_loss;
    ledger.rises = std::max(0.0, gained);
    report.moves.tried += after.size();
}

}  // namespace polargrain
