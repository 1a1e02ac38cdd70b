#include "src/engines/contact/halfway.h"

#include <algorithm>
#include <cmath>

#include "src/engines/contact/lever_arms.h"

namespace polargrain {

void Halfway::find(const PoseSet& start, const std::vector<SolverBody>& bodies, double dt) {
    start_ = &start;
    const double half = 0.5 * dt;
    centre_.resize(bodies.size());
    turn_.resize(bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        centre_[k] = start.centre[k] + half * bodies[k].velocity;
        // q stands for the tangent of half the angle: a true rotation, off in its angle by a twelfth of its cube.
        const double q = 0.5 * half * bodies[k].spin;
        const double per = 1.0 / (1.0 + q * q);
        turn_[k] = {(1.0 - q * q) * per, 2.0 * q * per};
    }
}

Vec2 Halfway::turned(GrainIndex grain, const Vec2& v) const {
    const Turn& t = turn_[Grains::at(grain)];
    return {t.cosine * v.x() - t.sine * v.y(), t.sine * v.x() + t.cosine * v.y()};
}

void Halfway::carry(GapContact& c) const {
    c.met = false;
    const BodyIndex owner = c.on_i ? c.i : c.j;
    const BodyIndex other = c.on_i ? c.j : c.i;
    // A vertex keeps its place on its body; the edge it faces turns with the other.
    if (c.vertex >= 0 || is_wall(owner)) {
        if (!is_wall(owner)) {
            c.point = centre(owner) + turned(owner, c.point - start_->centre[Grains::at(owner)]);
        }
        if (!is_wall(other)) c.normal = turned(other, c.normal);
        return;
    }
    // The point of a disk stays below its centre, along a normal that turns with what it faces.
    if (!is_wall(other)) {
        if (std::holds_alternative<Disk>(scene_.shape_of(other))) {
            const Vec2 apart = centre(c.i) - centre(c.j);
            c.normal = apart / std::sqrt(apart.squaredNorm());
        } else {
            c.normal = turned(other, c.normal);
        }
    }
    c.point = centre(owner) + disk_arm(c, owner);
}

Vec2 Halfway::disk_arm(const GapContact& c, GrainIndex grain) const {
    const bool two = !is_wall(c.j) && std::holds_alternative<Disk>(scene_.shape_of(c.i == grain ? c.j : c.i));
    const double gap = two ? 0.5 * std::clamp(c.gap, 0.0, c.resting) : 0.0;
    const double length = std::get<Disk>(scene_.shape_of(grain)).radius() + gap;
    return (c.i == grain ? -length : length) * c.normal;
}

Vec2 Halfway::arm(const GapContact& c, GrainIndex grain) const {
    if (c.met) return lever_arm(c, grain);
    if (std::holds_alternative<Disk>(scene_.shape_of(grain))) return disk_arm(c, grain);
    return c.point - centre(grain);
}

void Halfway::set_arms(GapContact& c, const std::vector<SolverBody>& bodies) const {
    set_lever_arms(c, bodies, arm(c, c.i), is_wall(c.j) ? Vec2(Vec2::Zero()) : arm(c, c.j));
}

}  // namespace polargrain
