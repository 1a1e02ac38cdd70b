#pragma once

#include "src/engines/contact/footing.h"
#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/impact_law.h"

namespace polargrain {

/// One impact at two contacts of a pair of bodies, shared in given parts; or at one, where both are the same.
class SharedImpact {
public:
    /// The bodies of the contacts, free or on their feet. `share`: what the second contact gets of the impulse, 0 to 1.
    SharedImpact(const GapContact& first, const GapContact& second, const Footing& i, const Footing& j, double share);

    /// By Stronge's law. `held`: the bodies cannot turn against one another, which takes two contacts.
    ImpactResult solve(double restitution, bool held) const;

    /// By how much impulses change the spin of i against j [rad/s].
    double turn(const ImpactResult& p) const;

    /// Can a couple turn the bodies against one another at all?
    bool yields() const { return couple_.turn > 0.0; }

    /// Gives i the impulses, and j their reaction.
    void push(const ImpactResult& p, Footing& i, Footing& j) const;

private:
    /// A unit impulse along one direction, as what each contact gets of it, and the change of the velocities of i
    /// relative to j at the contacts that follows from it.
    struct Lever {
        Vec2 at_first = Vec2::Zero(), at_second = Vec2::Zero();
        Vec2 first_after = Vec2::Zero(), second_after = Vec2::Zero();
        double turn = 0.0;  ///< of i against j [rad/s]
    };
    void pull(Lever& lever, const Footing& i, const Footing& j) const;
    void answer(Lever& lever, const Footing& i, const Footing& j, const Footing& i_after, const Footing& j_after) const;
    double moment(const Lever& lever, const Footing& body) const;
    double inverse_mass(const Lever& p, const Lever& q, bool held) const;

    Vec2 first_, second_;  ///< points of the contacts
    Lever normal_, tangent_;
    Lever couple_;  ///< what a unit couple between the bodies does; nothing at a single contact, which can hold none
    RelativeVelocity before_;
    double friction_;
};

/// What a face gets that lands flat: one impact, shared by two contacts of one pair of bodies.
struct FaceBlow {
    ImpactResult result;  ///< of both together
    double of_second =
        0;  ///< share of the impulse that the second contact gets; 0 or 1 where the face tips over an end
};

/// The impact of two bodies that meet in two contacts at once, with all but parallel normals and equal closing speeds;
/// or in one, given twice.
///
/// One after the other the contacts would throw the bodies into a spin, by an amount that depends on which comes first.
/// Bodies that meet in a face keep their relative spin as long as it presses on both of its ends, and the pressure is
/// where it has to be for that: friction at the face shifts it to the end that runs ahead. So the impact acts at that
/// point between the two contacts, by Stronge's law with the inverse masses of bodies that cannot turn against one
/// another; where there is no such point, at the nearer end, over which the face tips. Derived here.
///
/// The point's motion is a weighted mean of the contacts' own, so that what the law takes is what the two
/// impulses take, to round-off.
FaceBlow solve_face_blow(const GapContact& first, const GapContact& second, const Footing& i, const Footing& j,
                         double restitution);

}  // namespace polargrain
