#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

constexpr std::size_t k_reals = 16;

void append(const SoftContact& c, std::vector<double>& reals) {
    reals.insert(reals.end(), {c.point.x(), c.point.y(), c.normal.x(), c.normal.y(), c.depth, c.normal_force,
                               c.elastic_normal, c.sliding_force, c.stored_normal, c.stored_sliding, c.hysteresis,
                               c.damping, c.stretch, c.turning, c.largest, c.moment});
}

SoftContact contact_from(std::int64_t a, std::int64_t b, const double* r) {
    SoftContact c;
    c.a = static_cast<BodyIndex>(a);
    c.b = static_cast<BodyIndex>(b);
    c.point = {r[0], r[1]};
    c.normal = {r[2], r[3]};
    double* const values[] = {&c.depth,         &c.normal_force,   &c.elastic_normal, &c.sliding_force,
                              &c.stored_normal, &c.stored_sliding, &c.hysteresis,     &c.damping,
                              &c.stretch,       &c.turning,        &c.largest,        &c.moment};
    std::size_t k = 4;
    for (double* value : values) *value = r[k++];
    return c;
}

}  // namespace

void SoftSystem::save(Checkpoint& checkpoint) const {
    checkpoint.put("dem/numbers", std::vector<std::int64_t>(numbers_.begin(), numbers_.end()));
    std::vector<std::int64_t> bodies;
    std::vector<double> reals;
    for (const SoftContact& c : contacts_) {
        bodies.insert(bodies.end(), {c.a, c.b});
        append(c, reals);
    }
    checkpoint.put("dem/bodies", std::move(bodies));
    checkpoint.put("dem/contacts", std::move(reals));
}

void SoftSystem::load(const Checkpoint& checkpoint) {
    const auto& numbers = checkpoint.integers("dem/numbers");
    adopt(Numbering(numbers.begin(), numbers.end()));
    const auto& bodies = checkpoint.integers("dem/bodies");
    const auto& reals = checkpoint.reals("dem/contacts");
    contacts_.clear();
    turnover_ = {};
    for (std::size_t k = 0; 2 * k < bodies.size(); ++k) {
        contacts_.push_back(contact_from(bodies[2 * k], bodies[2 * k + 1], reals.data() + k_reals * k));
        turnover_.stored.add(contacts_.back());
    }
}

}  // namespace polargrain
