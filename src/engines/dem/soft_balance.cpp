#include <algorithm>
#include <cmath>

#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

/// Share of a pair's work below which a miss is left as it is. Misses of that size have either sign and add up to less
/// than 1e-7 of the energy of a pour; to mend them all would cost half as much again.
constexpr double k_not_worth_it = 1e-5;

bool same_pair(const SoftContact& c, const SoftContact& d) { return c.a == d.a && c.b == d.b; }

bool before(const SoftContact& c, const SoftContact& d) { return c.a != d.a ? c.a < d.a : c.b < d.b; }

/// Impulse [N s/m] that adds the energy [J/m] to a mass that separates at the speed [m/s]: the smaller of the two.
double impulse_of(double energy, double mass, double speed) {
    const double squared = speed * speed + 2.0 * energy / mass;
    if (!(squared > 0.0)) return -mass * speed;
    return energy == 0.0 ? 0.0 : 2.0 * energy / (speed + std::copysign(std::sqrt(squared), speed));
}

}  // namespace

// The work of a force is the mean of its values at both ends times the way. With that, kick, drift and kick give back
// what linear springs gave up, but for h^2 sum m a^2 / 8, which is back when forces are gone. Three things are amiss
// with it: a contact that begins or ends inside the step works as if it had been there for all of it, a normal that
// turns and a spring that is not linear. The second kick is mended for each pair, one after the other, so that the next
// sees the velocities that the last has left.
void SoftSystem::balance_work(double h, std::span<double> v) {
    balance_.changes.clear();
    balance_.on_walls.clear();
    balance_.spared = 0.0;
    std::size_t e = 0;
    for (std::size_t m = 0; m < missed_.size();) {
        const SoftContact& first = contacts_[missed_[m].contact];
        for (; e < ended_.size() && before(next_[ended_[e]], first); ++e) end_contact(next_[ended_[e]], h, v);
        SoftContact* strongest = &contacts_[missed_[m].contact];
        double energy = 0.0;
        double forces = 0.0;
        for (; m < missed_.size() && same_pair(contacts_[missed_[m].contact], first); ++m) {
            SoftContact& contact = contacts_[missed_[m].contact];
            energy += missed_[m].energy;
            forces += missed_[m].forces;
            if (contact.elastic_normal > strongest->elastic_normal) strongest = &contact;
        }
        // Two regions have become one, or one of them has gone.
        for (; e < ended_.size() && same_pair(next_[ended_[e]], first); ++e) {
            const SoftContact& old = next_[ended_[e]];
            energy += old.stored_normal - 0.5 * old.elastic_normal * way_of(old, previous_x_, accepted_x_, h);
            forces += old.elastic_normal;
        }
        strongest->impulse += balance(*strongest, accepted_x_, energy, 0.5 * h * forces, v);
    }
    for (; e < ended_.size(); ++e) end_contact(next_[ended_[e]], h, v);
}

// Spring and dashpot of a contact that has ended worked on the part of the way that lay inside it: as much of it as the
// spring had energy for.
void SoftSystem::end_contact(SoftContact& old, double h, std::span<double> v) {
    if (is_wall(old.a) && !walls_.present(old.a)) return;
    const double way = way_of(old, previous_x_, accepted_x_, h);
    const double elastic = 0.5 * old.elastic_normal * way;
    if (!(elastic > 0.0)) return;
    const double missed = 1.0 - old.stored_normal / elastic;
    balance_.spared += 0.5 * missed * (old.elastic_normal - old.normal_force) * way;
    old.impulse +=
        balance(old, previous_x_, -0.5 * missed * old.normal_force * way, 0.5 * h * std::abs(old.normal_force), v);
}

double SoftSystem::way_of(const SoftContact& old, const Shift& a, const Shift& b, std::span<const double> from,
                          double dt) const {
    const auto way = [&](BodyIndex grain, const Shift& shift) {
        if (bodies_[Grains::at(grain)].disk) return shift.way;
        return Vec2(shift.way + cross(shift.turn, Vec2(old.point - place(from, grain))));
    };
    if (!is_wall(old.a)) return (way(old.b, b) - way(old.a, a)).dot(old.normal);
    const Motion& wall = walls_.going_at_first(old.a);
    return (way(old.b, b) - dt * (wall.velocity + cross(wall.spin, old.point))).dot(old.normal);
}

void SoftSystem::find_miss(Share& share, const SoftContact* old, double way, double old_way) {
    const SoftContact& contact = share.found.back();
    double work = 0.5 * contact.elastic_normal * way;
    double turned = std::abs(work);
    Miss miss{share.found.size() - 1, -contact.stored_normal - contact.hysteresis, contact.elastic_normal};
    if (old != nullptr) {
        const double before = 0.5 * old->elastic_normal * old_way;
        work += before;
        turned += std::abs(before);
        miss.energy += old->stored_normal;
        miss.forces += old->elastic_normal;
    }
    miss.energy -= work;
    if (std::abs(miss.energy) > k_not_worth_it * turned) share.missed.push_back(miss);
}

Vec2 SoftSystem::balance(const SoftContact& c, std::span<const double> x, double energy, double most,
                         std::span<double> v) {
    const double speed = relative_velocity(c, wall_motion(c.a), x, v).dot(c.normal);
    const Vec2 arm_b = c.point - place(x, c.b);
    const Vec2 arm_a = is_wall(c.a) ? Vec2::Zero() : Vec2(c.point - place(x, c.a));
    const double free = impulse_of(energy, effective_mass(c, arm_a, arm_b), speed);
    const Vec2 impulse = std::clamp(free, -most, most) * c.normal;
    push(c.b, arm_b, impulse, v);
    if (is_wall(c.a)) {
        balance_.on_walls.push_back({wall_index(c.a), c.point, impulse});
    } else {
        push(c.a, arm_a, -impulse, v);
    }
    return impulse;
}

void SoftSystem::push(BodyIndex grain, const Vec2& arm, const Vec2& impulse, std::span<double> v) {
    const Body& body = bodies_[Grains::at(grain)];
    const Motion change{body.inverse_mass * impulse, body.inverse_inertia * cross(arm, impulse)};
    const std::size_t k = 3 * Grains::at(grain);
    v[k] += change.velocity.x();
    v[k + 1] += change.velocity.y();
    v[k + 2] += change.spin;
    balance_.changes.push_back({grain, change});
}

}  // namespace polargrain
