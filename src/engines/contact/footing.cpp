#include "src/engines/contact/footing.h"

#include <cmath>
#include <utility>

namespace polargrain {

namespace {

/// Slip against which friction may stand, relative to what the foot could do: round-off.
constexpr double k_no_slip = 1e-9;

}  // namespace

Footing::Footing(Vec2 velocity) : velocity_(std::move(velocity)) {}

Footing::Footing(const SolverBody& body, Vec2 centre)
    : centre_(std::move(centre)),
      velocity_(body.velocity),
      spin_(body.spin),
      inverse_mass_(body.inverse_mass),
      inverse_inertia_(body.inverse_inertia) {}

Footing::Footing(const SolverBody& body, const Vec2& centre, const GapContact& foot, Grip grip)
    : Footing(body, centre) {
    foot_ = &foot;
    grip_ = grip;
    if (grip != Grip::holds) return;
    // The impulse that stops the foot has no moment about it.
    const Vec2 arm = centre - foot.point;
    const Vec2 own = velocity_ - foot.wall_velocity;
    const double about_centre = 1.0 / inverse_inertia_;
    const double about_foot = about_centre + arm.squaredNorm() / inverse_mass_;
    const double spin = (about_centre * spin_ + cross(arm, own) / inverse_mass_) / about_foot;
    const Vec2 stop = (cross(spin, arm) - own) / inverse_mass_;
    push_foot(stop, foot_velocity());
}

/// `velocity_before` [m/s]: of the foot, before the blow of which p is part.
void Footing::push_foot(const Vec2& p, const Vec2& velocity_before) {
    push(p, moment(p, foot_->point));
    foot_impulse_ += p;
    const Vec2 mean = 0.5 * (velocity_before + foot_velocity());
    const Vec2 t = foot_->tangent();
    restitution_loss_ -= p.dot(foot_->normal) * mean.dot(foot_->normal);
    friction_loss_ -= p.dot(t) * mean.dot(t);
}

void Footing::push(const Vec2& p, double of_p) {
    velocity_ += inverse_mass_ * p;
    spin_ += inverse_inertia_ * of_p;
}

/// What the foot adds to an impulse: it keeps the foot from sinking, and from slipping if it holds.
Vec2 Footing::reaction(const Vec2& p, double of_p) const {
    if (!stands()) return Vec2::Zero();
    const Vec2 arm = foot_->point - centre_;
    const auto foot_answer = [&](const Vec2& impulse, double about) {
        return Vec2(inverse_mass_ * impulse + cross(inverse_inertia_ * about, arm));
    };
    const Vec2 driven = foot_answer(p, of_p);
    const Vec2& n = foot_->normal;
    const Vec2 t = foot_->tangent();
    if (grip_ == Grip::holds) {
        const Vec2 by_n = foot_answer(n, moment(n, foot_->point));
        const Vec2 by_t = foot_answer(t, moment(t, foot_->point));
        const double nn = by_n.dot(n);
        const double nt = by_n.dot(t);
        const double tt = by_t.dot(t);
        const double per = 1.0 / (nn * tt - nt * nt);
        const double d_n = driven.dot(n);
        const double d_t = driven.dot(t);
        return per * ((nt * d_t - tt * d_n) * n + (nt * d_n - nn * d_t) * t);
    }
    const Vec2 along = n + (grip_ == Grip::slips_back ? foot_->friction : -foot_->friction) * t;
    return -driven.dot(n) / foot_answer(along, moment(along, foot_->point)).dot(n) * along;
}

Footing Footing::after(const Vec2& p, double of_p) const {
    Footing after = *this;
    after.push(p, of_p);
    if (stands()) {
        const Vec2 foot = reaction(p, of_p);
        after.push(foot, moment(foot, foot_->point));
    }
    return after;
}

void Footing::take(const Vec2& p, double of_p) {
    if (!stands()) {
        push(p, of_p);
        return;
    }
    const Vec2 foot = reaction(p, of_p);
    const Vec2 before = foot_velocity();
    push(p, of_p);
    push_foot(foot, before);
}

bool Footing::is_consistent() const {
    if (!stands()) return true;
    const double pressing = foot_impulse_.dot(foot_->normal);
    if (pressing < 0.0) return false;
    const Vec2 t = foot_->tangent();
    if (grip_ == Grip::holds) return std::abs(foot_impulse_.dot(t)) <= foot_->friction * pressing;
    const double slip = foot_velocity().dot(t);
    const double round_off = k_no_slip * inverse_mass_ * pressing;
    return grip_ == Grip::slips_back ? slip < round_off : slip > -round_off;
}

}  // namespace polargrain
