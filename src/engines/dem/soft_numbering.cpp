#include <utility>

#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

/// Distance of the numbers of touching grains, summed over the contacts of a grain, from which on their coordinates are
/// far apart in memory: those of so many grains fill a good part of a core's cache.
constexpr double k_far_apart = 2048.0;

}  // namespace

bool SoftSystem::is_scattered() const {
    double distance = 0.0;
    for (const SoftContact& c : contacts_) distance += is_wall(c.a) ? 0.0 : c.b - c.a;
    return distance > k_far_apart * static_cast<double>(bodies_.size());
}

void SoftSystem::adopt(const Numbering& numbers) {
    numbers_ = numbers;
    bodies_.clear();
    for (const GrainIndex k : numbers_) {
        const Shape& shape = scene_.shape_of(k);
        bodies_.push_back({1.0 / scene_.grains.mass[Grains::at(k)], 1.0 / scene_.grains.inertia[Grains::at(k)],
                           outer_radius(shape), &shape, scene_.grains.material[Grains::at(k)],
                           std::holds_alternative<Disk>(shape)});
    }
    poses_.resize(bodies_.size());
    candidates_.renumber(numbers_);
}

// What a contact keeps counts along its normal and tangent, which turn together where its bodies change places.
void SoftSystem::renumber(const Numbering& numbers) {
    const Numbering places = places_of(numbers);
    const auto moved = [&](BodyIndex body) {
        return is_wall(body) ? body : places[Grains::at(numbers_[Grains::at(body)])];
    };
    std::vector<PairSorter::Pair> pairs;
    for (SoftContact& c : contacts_) {
        c.a = moved(c.a);
        c.b = moved(c.b);
        if (c.a > c.b) {
            std::swap(c.a, c.b);
            c.normal = -c.normal;
            c.moment = -c.moment;
            c.impulse = -c.impulse;
        }
        pairs.emplace_back(c.a, c.b);
    }
    PairSorter sorter;
    next_.clear();
    for (const std::uint32_t k : sorter.sort(pairs, scene_.walls.size(), numbers.size())) {
        next_.push_back(contacts_[k]);
    }
    contacts_.swap(next_);
    adopt(numbers);
}

}  // namespace polargrain
