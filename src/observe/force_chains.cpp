#include "src/observe/force_chains.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/core/elementary.h"
#include "src/observe/structure.h"

namespace polargrain {

namespace {

constexpr std::size_t k_shortest = 3;

/// The principal stress of a grain, up to its area.
struct GrainStress {
    double major = 0.0;
    Vec2 direction = Vec2::UnitX();
};

void add(SymmetricTensor& sum, const Vec2& force, const Vec2& arm) {
    sum.xx -= force.x() * arm.x();
    sum.yy -= force.y() * arm.y();
    sum.xy -= 0.5 * (force.x() * arm.y() + force.y() * arm.x());
}

std::vector<GrainStress> grain_stresses(const Grains& grains, std::span<const Contact> contacts) {
    std::vector<SymmetricTensor> sums(grains.x.size());
    for (const Contact& c : contacts) {
        add(sums[Grains::at(c.b)], c.impulse, c.point - grains.position(c.b));
        if (!is_wall(c.a)) add(sums[Grains::at(c.a)], -c.impulse, c.point - grains.position(c.a));
    }
    std::vector<GrainStress> stresses;
    stresses.reserve(sums.size());
    for (const SymmetricTensor& sum : sums) {
        const auto [sine, cosine] = sine_cosine(sum.direction());
        stresses.push_back({sum.major(), {cosine, sine}});
    }
    return stresses;
}

double mean_of_stressed(const std::vector<GrainStress>& stresses) {
    double sum = 0.0;
    double n = 0.0;
    for (const GrainStress& s : stresses) {
        if (s.major <= 0.0) continue;
        sum += s.major;
        n += 1.0;
    }
    return n > 0.0 ? sum / n : 0.0;
}

/// Sets that are joined pair by pair; each is known by its least member.
class JoinedSets {
public:
    explicit JoinedSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
    std::size_t find(std::size_t k) const {
        while (parent_[k] != k) k = parent_[k];
        return k;
    }
    void join(std::size_t a, std::size_t b) {
        const std::size_t p = find(a);
        const std::size_t q = find(b);
        parent_[std::max(p, q)] = std::min(p, q);
    }

private:
    std::vector<std::size_t> parent_;
};

}  // namespace

double ForceChains::mean_length() const {
    if (chains.empty()) return std::nan("");
    double grains = 0.0;
    for (const auto& chain : chains) grains += static_cast<double>(chain.size());
    return grains / static_cast<double>(chains.size());
}

ForceChains find_force_chains(const Grains& grains, std::span<const Contact> contacts) {
    const std::vector<GrainStress> stresses = grain_stresses(grains, contacts);
    const double mean = mean_of_stressed(stresses);
    const auto linked = [&](const Contact& c) {
        const GrainStress& p = stresses[Grains::at(c.a)];
        const GrainStress& q = stresses[Grains::at(c.b)];
        if (p.major <= mean || q.major <= mean) return false;
        const Vec2 way = unit(grains.position(c.b) - grains.position(c.a));
        const double least = std::sqrt(0.5);
        return std::abs(way.dot(p.direction)) >= least && std::abs(way.dot(q.direction)) >= least;
    };
    JoinedSets sets(grains.x.size());
    for (const Contact& c : contacts) {
        if (!is_wall(c.a) && linked(c)) sets.join(Grains::at(c.a), Grains::at(c.b));
    }
    std::vector<std::vector<GrainIndex>> members(grains.x.size());
    for (GrainIndex k = 0; k < grains.size(); ++k) members[sets.find(Grains::at(k))].push_back(k);

    ForceChains found;
    double carried = 0.0;
    double all = 0.0;
    for (const Contact& c : contacts) {
        if (is_wall(c.a)) continue;
        const double force = std::abs(c.impulse.dot(c.normal));
        all += force;
        if (linked(c) && members[sets.find(Grains::at(c.a))].size() >= k_shortest) carried += force;
    }
    found.force_share = all > 0.0 ? carried / all : 0.0;
    for (auto& chain : members) {
        if (chain.size() >= k_shortest) found.chains.push_back(std::move(chain));
    }
    return found;
}

}  // namespace polargrain
