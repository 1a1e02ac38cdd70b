#include <algorithm>
#include <cmath>

#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

/// Share of a pair's work below which a miss is left as it is. Misses of that size have either sign and add up to less
/// than 1e-7 of the energy of a pour; to mend them all would cost half as much again.
constexpr double k_not_worth_it = 1e-5;

/// What the normal springs of one pair did and should have done during a step [J/m].
struct PairWork {
    double done = 0.0;    ///< by forces, each the mean of its values at both ends
    double given = 0.0;   ///< energy that springs gave up
    double turned = 0.0;  ///< by all of them, without regard to sign
    double most = 0.0;    ///< impulses of the forces [N s/m]

    void add(double impulse, double rate) {
        done += impulse * rate;
        turned += std::abs(impulse * rate);
        most += impulse;
    }
};

bool same_pair(const SoftContact& c, const SoftContact& d) { return c.a == d.a && c.b == d.b; }

bool before(const SoftContact& c, const SoftContact& d) { return c.a != d.a ? c.a < d.a : c.b < d.b; }

/// End of the contacts of the pair that the contact at `first` is of.
std::size_t end_of_pair(const std::vector<SoftContact>& contacts, std::size_t first) {
    std::size_t end = first;
    while (end < contacts.size() && same_pair(contacts[end], contacts[first])) ++end;
    return end;
}

SoftContact& strongest(std::span<SoftContact> contacts) {
    const auto weaker = [](const SoftContact& c, const SoftContact& d) { return c.elastic_normal < d.elastic_normal; };
    return *std::max_element(contacts.begin(), contacts.end(), weaker);
}

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
void SoftSystem::balance_work(double h, std::span<const double> half, std::span<double> v) {
    const std::vector<SoftContact>& old = next_;
    balance_.changes.clear();
    balance_.on_walls.clear();
    balance_.spared = 0.0;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < old.size() || j < contacts_.size()) {
        const bool ended = j == contacts_.size() || (i < old.size() && before(old[i], contacts_[j]));
        const bool born = !ended && (i == old.size() || before(contacts_[j], old[i]));
        const std::size_t old_end = born ? i : end_of_pair(old, i);
        const std::size_t now_end = ended ? j : end_of_pair(contacts_, j);
        const std::span<const SoftContact> was(old.data() + i, old_end - i);
        const std::span<SoftContact> is(contacts_.data() + j, now_end - j);
        i = old_end;
        j = now_end;
        if (ended) {
            end_pair(was, h, half, v);
        } else {
            go_on_with_pair(was, is, h, half, v);
        }
    }
}

/// How fast the bodies part along the normal [m/s]; disks do so whatever their spins are.
double SoftSystem::parting_rate(const SoftContact& c, const Motion& wall, std::span<const double> x,
                                std::span<const double> v) const {
    if (any_polygon_ || is_wall(c.a)) return relative_velocity(c, wall, x, v).dot(c.normal);
    const double* of_a = v.data() + 3 * Grains::at(c.a);
    const double* of_b = v.data() + 3 * Grains::at(c.b);
    return (of_b[0] - of_a[0]) * c.normal.x() + (of_b[1] - of_a[1]) * c.normal.y();
}

void SoftSystem::go_on_with_pair(std::span<const SoftContact> was, std::span<SoftContact> is, double h,
                                 std::span<const double> half, std::span<double> v) {
    PairWork work;
    for (const SoftContact& c : was) {
        const double rate = parting_rate(c, motion_before(c.a), previous_x_, half);
        work.add(0.5 * h * c.elastic_normal, rate);
        work.given += c.stored_normal;
    }
    for (const SoftContact& c : is) {
        const double rate = parting_rate(c, wall_motion(c.a), accepted_x_, half);
        work.add(0.5 * h * c.elastic_normal, rate);
        work.given -= c.stored_normal + c.hysteresis;
    }
    if (std::abs(work.given - work.done) <= k_not_worth_it * work.turned) return;
    SoftContact& at = strongest(is);
    at.impulse += balance(at, accepted_x_, work.given - work.done, work.most, v);
}

// Spring and dashpot of a contact that has ended worked on the part of the way that lay inside it: as much of it as the
// spring had energy for.
void SoftSystem::end_pair(std::span<const SoftContact> was, double h, std::span<const double> half,
                          std::span<double> v) {
    if (is_wall(was.front().a) && !walls_.present(was.front().a)) return;
    for (const SoftContact& c : was) {
        const double way = h * relative_velocity(c, motion_before(c.a), previous_x_, half).dot(c.normal);
        const double elastic = 0.5 * c.elastic_normal * way;
        if (!(elastic > 0.0)) continue;
        const double missed = 1.0 - c.stored_normal / elastic;
        balance_.spared += 0.5 * missed * (c.elastic_normal - c.normal_force) * way;
        balance(c, previous_x_, -0.5 * missed * c.normal_force * way, 0.5 * h * std::abs(c.normal_force), v);
    }
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
