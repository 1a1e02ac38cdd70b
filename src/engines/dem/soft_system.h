#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/engines/dem/candidates.h"
#include "src/engines/dem/contact_geometry.h"
#include "src/engines/dem/soft_law.h"
#include "src/model/checkpoint.h"

namespace polargrain {

/// The equations of motion of grains under gravity and soft contacts; coordinates x[3k], x[3k + 1], x[3k + 2] are
/// position [m] and angle [rad] of grain k, velocities and accelerations likewise.
///
/// Contacts have memory. `accelerations` works from the memory of the last accepted state and may be asked any number
/// of times; `accept` takes over what it found last. Threads share the search for contacts; forces are summed in the
/// order of the sorted contacts, so that the number of threads changes no bit.
class SoftSystem {
public:
    SoftSystem(const Scene& scene, const DemSettings& settings);

    std::size_t size() const { return 3 * bodies_.size(); }
    double shortest_contact() const { return laws_.shortest_contact(); }
    /// Number of the engine's step, from which random restitutions are drawn.
    void set_step(std::int64_t step) { step_ = step; }

    /// [m/s^2] and [rad/s^2], into `a`.
    void accelerations(double time, std::span<const double> x, std::span<const double> v, std::span<double> a);
    void accept(double time, std::span<const double> x);
    /// Declares the state of the contacts' memory to be the one at these coordinates: after a load, and where time is
    /// set back to zero.
    void set_accepted(double time, std::span<const double> x);
    /// Solves (1 - factor da/dx) dx = residual with the contacts found last, of
    /// which those that slip count as frictionless.
    void solve_implicit(double factor, std::span<const double> residual, std::span<double> dx) const;

    const std::vector<SoftContact>& contacts() const { return contacts_; }
    std::vector<SoftContact>& contacts() { return contacts_; }
    const Motion& wall_motion(BodyIndex wall) const { return walls_.motion(wall_index(wall)); }

    /// What the last accepted evaluation ended and began.
    struct Turnover {
        std::int64_t born = 0;
        double dropped = 0.0;  ///< energy left in the springs of contacts that a removed wall ended [J/m]
    };
    const Turnover& turnover() const { return turnover_; }

    void save(Checkpoint& checkpoint) const;
    void load(const Checkpoint& checkpoint);

private:
    struct Body {
        double inverse_mass, inverse_inertia;
        double radius;  ///< outer [m]
        MaterialIndex material;
        bool disk;
    };

    void place_polygons(std::span<const double> x);
    /// What one thread finds in its share of the candidates, and its tools.
    struct Share {
        TouchFinder geometry;
        std::vector<Touch> touches;
        std::vector<SoftContact> found;
        std::size_t cursor = 0;  ///< first old contact that has not been passed
        std::int64_t born = 0;
    };

    void find_contacts(std::span<const double> x, std::span<const double> v);
    void meet_walls(Share& share, std::span<const double> x, std::span<const double> v);
    void meet_grains(Share& share, std::span<const GrainPair> pairs, std::span<const double> x,
                     std::span<const double> v);
    void add_contact(Share& share, BodyIndex a, BodyIndex b, const Touch& touch, std::span<const double> x,
                     std::span<const double> v);
    bool recall(Share& share, SoftContact& contact);
    void drop(const SoftContact& contact);
    double effective_mass(const SoftContact& contact, const Vec2& arm_a, const Vec2& arm_b) const;
    const PairSoftLaw& law_of(BodyIndex a, BodyIndex b) const;
    void sum_forces(std::span<const double> x, std::span<double> a) const;

    const Scene& scene_;
    SoftLaws laws_;
    SoftWalls walls_;
    Candidates candidates_;
    std::vector<Share> shares_;  ///< one for each thread
    std::vector<Body> bodies_;
    std::vector<Pose> poses_;  ///< of polygons
    bool any_polygon_ = false;
    std::int64_t step_ = 0;

    double time_ = 0.0;  ///< of the evaluation at hand [s]
    std::vector<SoftContact> contacts_, next_;
    std::vector<char> recalled_;  ///< old contacts that live on
    Turnover turnover_, next_turnover_;
    std::vector<double> evaluated_x_;  ///< of the evaluation at hand
    double accepted_time_ = 0.0;       ///< [s]
    std::vector<double> accepted_x_;
};

}  // namespace polargrain
