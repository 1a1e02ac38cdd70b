#include "src/engines/contact/stillness.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace polargrain {

namespace {

std::array<const std::vector<double>*, 6> state_of(const Grains& grains) {
    return {&grains.x, &grains.y, &grains.angle, &grains.vx, &grains.vy, &grains.spin};
}

/// To the last bit: zeros of either sign are equal, but not the same.
bool same(double p, double q) { return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q); }
bool same(const Vec2& p, const Vec2& q) { return same(p.x(), q.x()) && same(p.y(), q.y()); }

/// What the next step can see of a contact.
bool same_contact(const GapContact& p, const GapContact& q) {
    return p.i == q.i && p.j == q.j && p.vertex == q.vertex && p.edge == q.edge && p.piece == q.piece &&
           p.on_i == q.on_i && same(p.point, q.point) && same(p.normal, q.normal) && same(p.gap, q.gap) &&
           same(p.low, q.low) && same(p.high, q.high) && same(p.normal_impulse, q.normal_impulse) &&
           same(p.tangent_impulse, q.tangent_impulse);
}

/// Are the walls the same, and at rest, in all steps from `time` to the end of the next but one?
bool walls_stay(const Scene& scene, double time, double end) {
    return std::all_of(scene.walls.begin(), scene.walls.end(), [&](const Wall& wall) {
        return wall.present(time) == wall.present(end) && !(wall.present(time) && moves_between(wall, time, end));
    });
}

}  // namespace

bool Stillness::same_grains(const World& world) const {
    std::size_t first = 0;
    for (const std::vector<double>* values : state_of(world.grains)) {
        if (grains_.size() < first + values->size()) return false;
        const auto before = grains_.begin() + static_cast<std::ptrdiff_t>(first);
        if (!std::equal(values->begin(), values->end(), before, [](double p, double q) { return same(p, q); })) {
            return false;
        }
        first += values->size();
    }
    return true;
}

bool Stillness::holds(const Scene& scene, const World& world, double dt, StepReport& report) const {
    if (!still_ || dt != dt_ || report.record_impacts != report_.record_impacts) return false;
    if (!walls_stay(scene, world.time - dt, world.time + dt) || !same_grains(world)) return false;
    report = report_;
    return true;
}

void Stillness::remember(const World& world, const std::vector<GapContact>& contacts, int careful,
                         double opening_left) {
    grains_.clear();
    for (const std::vector<double>* values : state_of(world.grains)) {
        grains_.insert(grains_.end(), values->begin(), values->end());
    }
    // After a step that has moved something the next one is not still: whatever it does, it is looked at once more.
    watched_ = unmoved_;
    if (watched_) contacts_ = contacts;
    careful_ = careful;
    opening_left_ = opening_left;
}

void Stillness::judge(const Scene& scene, const World& world, const std::vector<GapContact>& contacts, int careful,
                      double opening_left, double time, double dt, const StepReport& report) {
    dt_ = dt;
    unmoved_ = same_grains(world);
    still_ = watched_ && unmoved_ && report.impacts == 0 && report.moves.rejected == 0 && careful == careful_ &&
             opening_left == opening_left_ && walls_stay(scene, time, time + dt) &&
             std::equal(contacts.begin(), contacts.end(), contacts_.begin(), contacts_.end(), same_contact);
    if (still_) report_ = report;
}

}  // namespace polargrain
