#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/detect/gap_points.h"
#include "src/engines/contact/impact_law.h"
#include "src/model/contact.h"

namespace polargrain {

/// A speculative contact of the refined engine: one point at which grain i may meet body j (a grain, or a wall).
///
/// The normal points out of j into i, t = (n_y, -n_x). Lever arms are taken in the middle of the step and hold for the
/// whole of it. While the solver runs, gap and impulses stand in ContactLanes. Three cache lines, of which the first
/// tells how fast the gap closes.
struct alignas(64) GapContact {
    BodyIndex i = 0, j = 0;  ///< i a grain; j a lower grain, or a wall
    std::int32_t vertex = 0, edge = 0, piece = 0;
    bool active = true;  ///< false once the point has left its edge for good in this step
    bool on_i = true;    ///< the point belongs to i
    bool met = false;    ///< point, normal and arms are those of a moment in flight (FlightMeetings), and not halfway
    double gap = 0.0;    ///< [m]
    Vec2 normal = Vec2::UnitY();
    double arm_ni = 0.0, arm_nj = 0.0;  ///< cross(r, n) [m]

    double resting = 0.0;               ///< the gap at which the pair rests [m]
    double arm_ti = 0.0, arm_tj = 0.0;  ///< cross(r, t) [m]
    double mass_n = 0.0, mass_t = 0.0;  ///< effective masses along n and t [kg/m]
    double friction = 0.0;
    double normal_impulse = 0.0;   ///< of the last sub-step, on i along n [N s/m], kept as the next one's first guess
    double tangent_impulse = 0.0;  ///< along t

    Vec2 point = Vec2::Zero();          ///< where the contact is [m]
    Vec2 wall_velocity = Vec2::Zero();  ///< of the wall's material at the point, in this sub-step [m/s]
    Vec2 total_impulse = Vec2::Zero();  ///< on i in this step [N s/m]
    double low = -std::numeric_limits<double>::infinity();  ///< travel for which the point stays over its edge [m]
    double high = std::numeric_limits<double>::infinity();

    Vec2 tangent() const { return right_normal(normal); }
    bool between_disks() const { return vertex < 0 && edge < 0 && !is_wall(j); }
};
static_assert(sizeof(GapContact) == 192);

/// The contact points of one pair of bodies: a run of an array of points, or of contacts made from them.
struct PairContacts {
    BodyIndex i = 0, j = 0;
    std::int32_t piece = -1;  ///< of the wall pieces, where j is a wall
    std::int32_t first = 0, count = 0;
    bool overlapping = false;
};

/// Contacts with walls stand behind all others: where they begin.
std::size_t first_with_wall(const std::vector<GapContact>& contacts);

/// Speculative contacts of the points of a pair, without impulses yet. resting: gap at which the pair rests [m].
void make_contacts(const PairContacts& pair, std::span<const GapPoint> points, double resting,
                   std::span<GapContact> contacts);

/// Multiplies the impulses, first guesses of the next sub-step, by a factor.
void scale_impulses(std::vector<GapContact>& contacts, double factor);

/// Gives the impulses of a pair's old contacts to its new ones, as first guesses of the solver.
void take_impulses_over(std::span<GapContact> now, std::span<GapContact> old);

/// Velocity and inverse inertia of a grain, side by side for the solver's sweeps and in one cache line.
struct alignas(64) SolverBody {
    Vec2 velocity = Vec2::Zero();
    double spin = 0.0;
    double inverse_mass = 0.0;
    double inverse_inertia = 0.0;
    bool touched = false;  ///< got an impulse in this step, or came so near that it might have
};

}  // namespace polargrain
