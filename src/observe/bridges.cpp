#include "src/observe/bridges.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "src/core/error.h"
#include "src/observe/bed.h"

namespace polargrain {

namespace {

constexpr double k_still = 0.05;  // speed over sqrt(g W)

/// An opening as seen from the grains above it.
struct Frame {
    Vec2 middle, along, up;
    double width;

    explicit Frame(const Scene& scene, const Opening& opening)
        : middle(0.5 * (opening.from + opening.to)),
          along(unit(opening.to - opening.from)),
          up(left_normal(along)),
          width(std::sqrt((opening.to - opening.from).squaredNorm())) {
        if (up.dot(scene.gravity) > 0.0) up = -up;
    }
    double station(const Vec2& p) const { return along.dot(p - middle); }
};

enum Side : char { left_side = 1, right_side = 2 };

/// Marks the grains that can be part of a bridge.
GrainMask still_grains(const Scene& scene, const Grains& grains, const Frame& frame) {
    const double limit = k_still * k_still * std::sqrt(scene.gravity.squaredNorm()) * frame.width;
    const double reach = frame.width + 2.0 * mean_outer_radius(scene);
    GrainMask still(grains.x.size(), 0);
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const Vec2 from_middle = grains.position(k) - frame.middle;
        const bool near = from_middle.squaredNorm() < reach * reach && from_middle.dot(frame.up) > 0.0;
        if (near && grains.velocity(k).squaredNorm() < limit) still[Grains::at(k)] = 1;
    }
    return still;
}

/// The sides of the opening on which a grain finds support.
std::vector<char> abutments(const Grains& grains, std::span<const Contact> contacts, const Frame& frame,
                            const GrainMask& still) {
    std::vector<char> sides(grains.x.size(), 0);
    for (const Contact& c : contacts) {
        if (is_wall(c.a)) sides[Grains::at(c.b)] |= frame.station(c.point) < 0.0 ? left_side : right_side;
    }
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const double s = frame.station(grains.position(k));
        if (still[Grains::at(k)] == 0) continue;
        if (s < -0.5 * frame.width) sides[Grains::at(k)] |= left_side;
        if (s > 0.5 * frame.width) sides[Grains::at(k)] |= right_side;
    }
    return sides;
}

using Neighbours = std::vector<std::vector<GrainIndex>>;

Neighbours touching(std::size_t grains, std::span<const Contact> contacts, const GrainMask& still) {
    Neighbours neighbours(grains);
    for (const Contact& c : contacts) {
        if (is_wall(c.a) || still[Grains::at(c.a)] == 0 || still[Grains::at(c.b)] == 0) continue;
        neighbours[Grains::at(c.a)].push_back(c.b);
        neighbours[Grains::at(c.b)].push_back(c.a);
    }
    return neighbours;
}

/// Breadth first from all grains on the left to the first on the right.
std::vector<GrainIndex> shortest_chain(const Neighbours& neighbours, const GrainMask& still,
                                       const std::vector<char>& sides) {
    constexpr GrainIndex k_unseen = -2, k_start = -1;
    std::vector<GrainIndex> came_from(still.size(), k_unseen);
    std::vector<GrainIndex> queue;
    for (std::size_t k = 0; k < still.size(); ++k) {
        if (still[k] == 0 || (sides[k] & left_side) == 0) continue;
        came_from[k] = k_start;
        queue.push_back(static_cast<GrainIndex>(k));
    }
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const GrainIndex at = queue[next];
        if ((sides[Grains::at(at)] & right_side) != 0) {
            std::vector<GrainIndex> chain;
            for (GrainIndex k = at; k != k_start; k = came_from[Grains::at(k)]) chain.push_back(k);
            std::reverse(chain.begin(), chain.end());
            return chain;
        }
        for (const GrainIndex k : neighbours[Grains::at(at)]) {
            if (came_from[Grains::at(k)] != k_unseen) continue;
            came_from[Grains::at(k)] = at;
            queue.push_back(k);
        }
    }
    return {};
}

}  // namespace

std::vector<GrainIndex> find_bridge(const Scene& scene, const Grains& grains, std::span<const Contact> contacts,
                                    const Opening& opening) {
    require(scene.gravity.squaredNorm() > 0.0, "bridges need gravity: set run.gravity, or leave the observable out");
    const Frame frame(scene, opening);
    const GrainMask still = still_grains(scene, grains, frame);
    if (std::find(still.begin(), still.end(), 1) == still.end()) return {};
    return shortest_chain(touching(grains.x.size(), contacts, still), still, abutments(grains, contacts, frame, still));
}

BridgeMeter::BridgeMeter(const Scene& scene, Opening opening, Measure measure)
    : scene_(&scene),
      opening_(std::move(opening)),
      measure_(measure),
      least_(std::sqrt(2.0 * mean_outer_radius(scene) / std::sqrt(scene.gravity.squaredNorm()))) {
    require(scene.gravity.squaredNorm() > 0.0, "bridges need gravity: set run.gravity, or leave the observable out");
}

void BridgeMeter::step(const World& world, double /*dt*/, const StepReport& report) {
    standing_grains_ = static_cast<double>(find_bridge(*scene_, world.grains, report.contacts, opening_).size());
    if (first_seen_ >= 0.0 && world.time - last_seen_ > least_) {
        if (last_seen_ - first_seen_ > least_) ended_.push_back(last_seen_ - first_seen_);
        first_seen_ = -1.0;
    }
    if (standing_grains_ == 0.0) return;
    if (first_seen_ < 0.0) first_seen_ = world.time;
    last_seen_ = world.time;
}

std::vector<double> BridgeMeter::lives() const {
    std::vector<double> all = ended_;
    if (first_seen_ >= 0.0 && last_seen_ - first_seen_ > least_) all.push_back(last_seen_ - first_seen_);
    return all;
}

double BridgeMeter::read(const Sample& sample) const {
    const std::vector<double> all = lives();
    const double sum = std::accumulate(all.begin(), all.end(), 0.0);
    switch (measure_) {
        case Measure::count: return static_cast<double>(all.size());
        case Measure::life: return all.empty() ? std::nan("") : sum / static_cast<double>(all.size());
        case Measure::time_share: return sample.world.time > 0.0 ? sum / sample.world.time : std::nan("");
        case Measure::grains: break;
    }
    return standing_grains_;
}

void BridgeMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/bridges_ended", ended_);
    checkpoint.put(prefix + "/bridge", std::vector{first_seen_, last_seen_, standing_grains_});
}

void BridgeMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    ended_ = checkpoint.reals(prefix + "/bridges_ended");
    const std::vector<double>& standing = checkpoint.reals(prefix + "/bridge");
    first_seen_ = standing.at(0);
    last_seen_ = standing.at(1);
    standing_grains_ = standing.at(2);
}

}  // namespace polargrain
