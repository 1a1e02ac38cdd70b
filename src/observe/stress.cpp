#include "src/observe/stress.h"

#include <algorithm>
#include <cmath>

#include "src/observe/bed.h"

namespace polargrain {

namespace {

/// Share of the piece from p to q that lies in the region.
double share_inside(const Vec2& p, const Vec2& q, const Region& region) {
    double first = 0.0;
    double last = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        const double way = q[axis] - p[axis];
        if (way == 0.0) {
            if (p[axis] < region.lower[axis] || p[axis] > region.upper[axis]) return 0.0;
            continue;
        }
        const double s = (region.lower[axis] - p[axis]) / way;
        const double t = (region.upper[axis] - p[axis]) / way;
        first = std::max(first, std::min(s, t));
        last = std::min(last, std::max(s, t));
    }
    return std::max(0.0, last - first);
}

}  // namespace

SymmetricTensor contact_moment(const Grains& grains, std::span<const Contact> contacts, const Region& region) {
    SymmetricTensor sum;
    for (const Contact& c : contacts) {
        if (!region.holds(c.point)) continue;
        const Vec2 branch = grains.position(c.b) - (is_wall(c.a) ? c.point : grains.position(c.a));
        sum.xx += c.impulse.x() * branch.x();
        sum.yy += c.impulse.y() * branch.y();
        sum.xy += 0.5 * (c.impulse.x() * branch.y() + c.impulse.y() * branch.x());
    }
    return sum;
}

void StressMeter::step(const World& world, double dt, const StepReport& report) {
    const SymmetricTensor moment = contact_moment(world.grains, report.contacts, region_);
    moment_.xx += moment.xx;
    moment_.xy += moment.xy;
    moment_.yy += moment.yy;
    interval_ += dt;
}

SymmetricTensor StressMeter::stress() const {
    const double scale = 1.0 / (interval_ * region_.area());
    return {moment_.xx * scale, moment_.xy * scale, moment_.yy * scale};
}

double StressMeter::read(const Sample& /*sample*/) {
    if (interval_ == 0.0) return std::nan("");
    const SymmetricTensor mean = stress();
    moment_ = {};
    interval_ = 0.0;
    switch (component_) {
        case Component::xx: return mean.xx;
        case Component::xy: return mean.xy;
        case Component::yy: return mean.yy;
        case Component::pressure: break;
    }
    return 0.5 * mean.trace();
}

void StressMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/stress", std::vector{moment_.xx, moment_.xy, moment_.yy, interval_});
}

void StressMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    const std::vector<double>& values = checkpoint.reals(prefix + "/stress");
    moment_ = {values.at(0), values.at(1), values.at(2)};
    interval_ = values.at(3);
}

double wall_length(const Wall& wall, double time, const std::optional<Region>& region) {
    const WallState state = wall_state(wall, time);
    double length = 0.0;
    for (std::size_t k = 1; k < wall.points.size(); ++k) {
        const Vec2 p = state.point(wall.points[k - 1]);
        const Vec2 q = state.point(wall.points[k]);
        length += std::sqrt((q - p).squaredNorm()) * (region ? share_inside(p, q, *region) : 1.0);
    }
    return length;
}

void WallMeter::step(const World& /*world*/, double dt, const StepReport& report) {
    for (const Contact& c : report.contacts) {
        if (c.a != wall_body(wall_) || !in_region(region_, c.point)) continue;
        normal_ += c.impulse.dot(c.normal);
        total_ -= c.impulse;
    }
    interval_ += dt;
}

double WallMeter::value(const Sample& sample) const {
    const Wall& wall = sample.scene.walls[static_cast<std::size_t>(wall_)];
    if (interval_ == 0.0 || !wall.present(sample.world.time)) return std::nan("");
    if (measure_ == Measure::pressure) {
        const double length = wall_length(wall, sample.world.time, region_);
        return length > 0.0 ? normal_ / (interval_ * length) : std::nan("");
    }
    double mass = 0.0;
    for (const GrainIndex k : grains_in(sample.scene, sample.world.grains))
        mass += sample.world.grains.mass[Grains::at(k)];
    const double weight = mass * std::sqrt(sample.scene.gravity.squaredNorm());
    return weight > 0.0 ? -total_.dot(upwards(sample.scene)) / (interval_ * weight) : std::nan("");
}

double WallMeter::read(const Sample& sample) {
    const double now = value(sample);
    normal_ = 0.0;
    total_ = Vec2::Zero();
    interval_ = 0.0;
    return now;
}

void WallMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/wall", std::vector{normal_, total_.x(), total_.y(), interval_});
}

void WallMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    const std::vector<double>& values = checkpoint.reals(prefix + "/wall");
    normal_ = values.at(0);
    total_ = {values.at(1), values.at(2)};
    interval_ = values.at(3);
}

}  // namespace polargrain
