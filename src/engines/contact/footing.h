#pragma once

#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/impact_law.h"

namespace polargrain {

/// How a grain stands on a wall during an impact.
enum class Grip : std::uint8_t {
    holds,        ///< the foot stays where it is
    slips_back,   ///< it slips along -t of its contact, friction pulls it along +t at the limit of Coulomb's cone
    slips_ahead,  ///< the other way
};

/// One body of an impact: a wall, a free grain, or a grain that stands on a wall while another grain strikes it.
///
/// A wall answers as fast as the blow comes. A grain that stands cannot sink into it: it turns about its foot, or,
/// where friction cannot hold the foot, slips along the wall; the foot gets an impulse of its own at the same time.
/// What the blow sees of the body is this constrained motion; Stronge's law is the same. (Struck as free bodies, with
/// their feet mended by impacts of their own afterwards, bouncing dominoes lose up to a seventh of the speed of a chain
/// with pinned feet.)
class Footing {
public:
    /// A wall, by its velocity at the contact point [m/s].
    explicit Footing(Vec2 velocity);

    /// A free grain.
    Footing(const SolverBody& body, Vec2 centre);

    /// A grain that stands on the wall contact `foot`. What little speed the foot has is stopped first, where it holds.
    Footing(const SolverBody& body, const Vec2& centre, const GapContact& foot, Grip grip);

    bool stands() const { return foot_ != nullptr; }
    const GapContact* foot() const { return foot_; }

    /// Velocity of a point of the body [m/s].
    Vec2 velocity_at(const Vec2& point) const { return velocity_ + cross(spin_, Vec2(point - centre_)); }

    double spin() const { return spin_; }

    /// Of an impulse p at `point`, about the centre of mass [N s].
    double moment(const Vec2& p, const Vec2& point) const { return cross(Vec2(point - centre_), p); }

    /// The body after an impulse p [N s/m] with the moment of_p about the centre of mass, and after what the foot adds;
    /// nothing is booked.
    Footing after(const Vec2& p, double of_p) const;

    /// Takes the impulse p with that moment, and what the foot adds.
    void take(const Vec2& p, double of_p);

    /// On the grain at its foot, so far [N s/m].
    const Vec2& foot_impulse() const { return foot_impulse_; }

    /// Is what was assumed of the foot true: does it press, within the cone of friction, or slip against friction?
    bool is_consistent() const;

    /// Energy taken at the foot by what presses it and by friction, in the frame of its wall [J/m].
    double restitution_loss() const { return restitution_loss_; }
    double friction_loss() const { return friction_loss_; }

private:
    Vec2 reaction(const Vec2& p, double of_p) const;
    void push(const Vec2& p, double of_p);
    void push_foot(const Vec2& p, const Vec2& velocity_before);
    Vec2 foot_velocity() const { return velocity_at(foot_->point) - foot_->wall_velocity; }

    const GapContact* foot_ = nullptr;
    Grip grip_ = Grip::holds;
    Vec2 centre_ = Vec2::Zero();
    Vec2 velocity_ = Vec2::Zero();
    double spin_ = 0.0;
    double inverse_mass_ = 0.0, inverse_inertia_ = 0.0;
    Vec2 foot_impulse_ = Vec2::Zero();
    double restitution_loss_ = 0.0, friction_loss_ = 0.0;
};

}  // namespace polargrain
