#pragma once

#include <vector>

#include "src/engines/contact/gap_contact.h"
#include "src/engines/contact/pose_set.h"
#include "src/model/scene.h"

namespace polargrain {

/// Where grains and their contacts will be in the middle of a step, by the velocities at its beginning.
///
/// Lever arms and normals hold for a whole step. Taken at its middle they are right to second order in dt; taken at its
/// beginning, a grain that turns about a contact loses (w dt)^2 of its energy in every step, and the two arms of a pair
/// no longer meet in one point, so that angular momentum is lost.
class Halfway {
public:
    explicit Halfway(const Scene& scene) : scene_(scene) {}

    /// dt [s] of the step; zero leaves everything where it is.
    void find(const PoseSet& start, const std::vector<SolverBody>& bodies, double dt);

    /// Takes a contact's point and normal, found at the start, to the middle.
    void carry(GapContact& c) const;

    /// From the centre of a grain to where its surface meets the other body's, of a contact that has been carried, and
    /// turned to a meeting in flight perhaps [m].
    ///
    /// A disk's arm is its radius, whatever the gap was at the start: when the impulse comes, the gap is closed. Two
    /// disks share the gap at which they rest, so that their arms meet.
    Vec2 arm(const GapContact& c, GrainIndex grain) const;

    /// Gives a contact its lever arms and effective masses, from its point and normal.
    void set_arms(GapContact& c, const std::vector<SolverBody>& bodies) const;

    /// Centre of mass in the middle of the step [m].
    const Vec2& centre(GrainIndex grain) const { return centre_[Grains::at(grain)]; }

    /// A direction that turns with the grain, from where it was at the start.
    Vec2 turned(GrainIndex grain, const Vec2& v) const;

private:
    struct Turn {
        double cosine = 1.0, sine = 0.0;
    };
    Vec2 disk_arm(const GapContact& c, GrainIndex grain) const;

    const Scene& scene_;
    const PoseSet* start_ = nullptr;
    std::vector<Vec2> centre_;
    std::vector<Turn> turn_;
};

}  // namespace polargrain
