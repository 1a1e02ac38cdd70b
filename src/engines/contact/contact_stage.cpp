#include "src/engines/contact/contact_stage.h"

#include <algorithm>
#include <cmath>

#include "src/detect/wall_pieces.h"
#include "src/model/contact_law.h"

namespace polargrain {

namespace {

/// The heap's order: highest closing speed on top, ties by the lower contact number.
constexpr auto k_later = [](const auto& p, const auto& q) {
    return p.closing_speed < q.closing_speed || (p.closing_speed == q.closing_speed && p.contact > q.contact);
};

}  // namespace

ContactStage::ContactStage(const Scene& scene) : scene_(scene) {}

void ContactStage::process(const std::vector<RecordedContact>& contacts, World& world, double dt, StepReport& report) {
    if (contacts.empty()) return;
    least_closing_ = k_least_closing * std::sqrt(scene_.gravity.squaredNorm()) * dt;
    prepare(contacts, world);
    for (std::size_t k = 0; k < contacts.size(); ++k) queue(contacts[k], k, world.grains);

    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), k_later);
        const Queued next = heap_.back();
        heap_.pop_back();
        const auto k = static_cast<std::size_t>(next.contact);
        Prepared& prepared = prepared_[k];
        if (next.stamp != prepared.stamp) continue;
        exchange(contacts[k], prepared, world, report);
        ++prepared.uses;
        for (const BodyIndex body : {contacts[k].a, contacts[k].b}) {
            if (is_wall(body)) continue;
            const std::size_t g = Grains::at(body);
            for (auto n = first_of_grain_[g]; n < first_of_grain_[g + 1]; ++n) {
                const auto touched = static_cast<std::size_t>(of_grain_[static_cast<std::size_t>(n)]);
                queue(contacts[touched], touched, world.grains);
            }
        }
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const RecordedContact& c = contacts[k];
        report.contacts.push_back({c.a, c.b, c.point, c.normal, -c.depth, prepared_[k].impulse});
    }
}

void ContactStage::prepare(const std::vector<RecordedContact>& contacts, World& world) {
    walls_.clear();
    for (const Wall& wall : scene_.walls) walls_.push_back(wall_motion(wall_state(wall, world.time)));

    prepared_.clear();
    if (prepared_.capacity() < contacts.size()) {
        std::vector<Prepared>().swap(prepared_);  // the old room goes before the new one comes
        prepared_.reserve(contacts.size() + contacts.size() / 8);
    }
    heap_.clear();
    first_of_grain_.assign(world.grains.x.size() + 1, 0);
    for (const RecordedContact& c : contacts) {
        const ContactFrame frame = contact_frame(c.normal, c.point - c.centre_b, inertia_of(c.b, world.grains),
                                                 c.point - c.centre_a, inertia_of(c.a, world.grains));
        prepared_.push_back({frame, pair_law(scene_, c.a, c.b).friction,
                             drawn_restitution(scene_, world.step, c.a, c.b), 0, 0, Vec2::Zero()});
        if (!is_wall(c.a)) ++first_of_grain_[Grains::at(c.a) + 1];
        ++first_of_grain_[Grains::at(c.b) + 1];
    }
    for (std::size_t g = 0; g + 1 < first_of_grain_.size(); ++g) first_of_grain_[g + 1] += first_of_grain_[g];
    of_grain_.resize(static_cast<std::size_t>(first_of_grain_.back()));
    fill_.assign(first_of_grain_.begin(), first_of_grain_.end() - 1);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        for (const BodyIndex body : {contacts[k].a, contacts[k].b}) {
            if (is_wall(body)) continue;
            of_grain_[static_cast<std::size_t>(fill_[Grains::at(body)]++)] = static_cast<std::int32_t>(k);
        }
    }
}

void ContactStage::queue(const RecordedContact& contact, std::size_t k, const Grains& grains) {
    Prepared& prepared = prepared_[k];
    ++prepared.stamp;  // whatever stands in the queue for it is out of date
    if (prepared.uses >= k_most_uses) return;
    const double closing =
        relative_velocity(prepared.frame, motion_of(contact.b, grains), motion_of(contact.a, grains)).closing;
    if (closing >= -least_closing_) return;
    heap_.push_back({-closing, static_cast<std::int32_t>(k), prepared.stamp});
    std::push_heap(heap_.begin(), heap_.end(), k_later);
}

void ContactStage::exchange(const RecordedContact& contact, Prepared& prepared, World& world, StepReport& report) {
    Grains& grains = world.grains;
    const ContactFrame& frame = prepared.frame;
    const Motion b_before = motion_of(contact.b, grains);
    const Motion a_before = motion_of(contact.a, grains);
    const RelativeVelocity before = relative_velocity(frame, b_before, a_before);
    const ImpactResult result = solve_impact(frame, before, prepared.friction, prepared.restitution);

    Motion b_after = b_before;
    Motion a_after = a_before;
    apply_impulse(frame, result, inertia_of(contact.b, grains), b_after);
    apply_reaction(frame, result, inertia_of(contact.a, grains), a_after);
    grains.set_velocity(contact.b, b_after.velocity);
    grains.spin[Grains::at(contact.b)] = b_after.spin;

    const Vec2 impulse = result.tangential * frame.tangent() + result.normal * frame.normal;
    if (is_wall(contact.a)) {
        WallImpulse& wall = report.walls[static_cast<std::size_t>(wall_index(contact.a))];
        wall.linear -= impulse;
        wall.angular -= cross(contact.point, impulse);
        report.ledger.wall_work += impulse.dot(a_before.velocity + cross(a_before.spin, contact.point));
    } else {
        grains.set_velocity(contact.a, a_after.velocity);
        grains.spin[Grains::at(contact.a)] = a_after.spin;
    }
    prepared.impulse += impulse;
    report.ledger.restitution_loss += result.restitution_loss;
    report.ledger.friction_loss += result.friction_loss;
    ++report.impacts;
    if (report.record_impacts) {
        const RelativeVelocity after = relative_velocity(frame, b_after, a_after);
        report.impact_records.push_back({world.time,        world.step,       contact.b,
                                         contact.a,         contact.point,    contact.normal,
                                         contact.centre_b,  contact.centre_a, prepared.restitution,
                                         prepared.friction, result.mode,      result.normal,
                                         result.tangential, before.closing,   after.closing,
                                         before.sliding,    after.sliding,    b_before,
                                         a_before,          b_after,          a_after});
    }
}

Motion ContactStage::motion_of(BodyIndex body, const Grains& grains) const {
    if (is_wall(body)) return walls_[static_cast<std::size_t>(wall_index(body))];
    return {grains.velocity(body), grains.spin[Grains::at(body)]};
}

ImpactBody ContactStage::inertia_of(BodyIndex body, const Grains& grains) const {
    if (is_wall(body)) return {};
    return {1.0 / grains.mass[Grains::at(body)], 1.0 / grains.inertia[Grains::at(body)]};
}

}  // namespace polargrain
