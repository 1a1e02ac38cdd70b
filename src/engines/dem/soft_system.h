#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/core/parallel.h"
#include "src/engines/dem/candidates.h"
#include "src/engines/dem/contact_geometry.h"
#include "src/engines/dem/numbering.h"
#include "src/engines/dem/soft_law.h"
#include "src/model/checkpoint.h"

namespace polargrain {

/// The equations of motion of grains under gravity and soft contacts; coordinates x[3k], x[3k + 1], x[3k + 2] are
/// position [m] and angle [rad] of grain k, velocities and accelerations likewise.
///
/// Contacts have memory. `accelerations` works from the memory of the last accepted state and may be asked any number
/// of times; `accept` takes over what it found last. Grains are numbered as `numbers` says, which is nobody's business
/// outside the engine. Threads share the search for contacts; forces are summed in the
/// order of the sorted contacts, so that the number of threads changes no bit.
class SoftSystem {
public:
    SoftSystem(const Scene& scene, const DemSettings& settings);

    std::size_t size() const { return 3 * bodies_.size(); }
    double longest_step() const { return laws_.longest_step(); }
    /// Number of the engine's step, from which random restitutions are drawn, and length of the scheme's steps in it
    /// [s].
    void set_step(std::int64_t step, double length) {
        step_ = step;
        walls_.set_step(length);
    }

    /// [m/s^2] and [rad/s^2], into `a`.
    void accelerations(double time, std::span<const double> x, std::span<const double> v, std::span<double> a);
    void accept(double time, std::span<const double> x);
    /// Declares the state of the contacts' memory to be the one at these coordinates: after a load, and where time is
    /// set back to zero.
    void set_accepted(double time, std::span<const double> x);
    /// Solves (1 - factor da/dx) dx = residual with the contacts found last, of
    /// which those that slip count as frictionless, at the coordinates that they were found at, which must still stand.
    void solve_implicit(double factor, std::span<const double> residual, std::span<double> dx) const;

    /// After `accept`, for a step of kick, drift and kick of the length h [s]: adds impulses along the normals of
    /// contacts to v such that the springs have done as much work as they gave up energy.
    void balance_work(double h, std::span<double> v);

    const Numbering& numbers() const { return numbers_; }
    /// Are the numbers of touching grains far apart?
    bool is_scattered() const;
    /// Between two steps: all that is kept goes over to other numbers; coordinates are the caller's.
    void renumber(const Numbering& numbers);

    const std::vector<SoftContact>& contacts() const { return contacts_; }
    std::vector<SoftContact>& contacts() { return contacts_; }
    /// Appends the contacts that the last accepted evaluation ended, with their impulses up to there.
    void add_ended(std::vector<SoftContact>& ended) const;
    /// For how long the accepted forces act [s], as far as the contacts' impulses go.
    void weigh(double time) { weight_ = time; }
    /// Of the body's material where it is a wall, at the world's origin; none for a grain.
    Motion wall_motion(BodyIndex body) const { return is_wall(body) ? walls_.motion(body) : Motion{}; }
    /// Of b's material against a's at a contact [m/s]; `wall`: how a moves if it is a wall.
    static Vec2 relative_velocity(const SoftContact& c, const Motion& wall, std::span<const double> x,
                                  std::span<const double> v) {
        const Vec2 of_b = velocity_at(v, c.b, c.point - place(x, c.b));
        if (is_wall(c.a)) return of_b - (wall.velocity + cross(wall.spin, c.point));
        return of_b - velocity_at(v, c.a, c.point - place(x, c.a));
    }

    /// Of b against a [rad/s].
    static double relative_spin(const SoftContact& c, const Motion& wall, std::span<const double> v) {
        return spin_of(v, c.b) - (is_wall(c.a) ? wall.spin : spin_of(v, c.a));
    }

    /// What `balance_work` did last; empty under a scheme that does not call it.
    struct Balance {
        struct OnWall {
            int wall = 0;
            Vec2 point = Vec2::Zero();    ///< [m]
            Vec2 impulse = Vec2::Zero();  ///< on the grain [N s/m]
        };
        struct Change {
            BodyIndex grain = 0;
            Motion of;
        };
        std::vector<Change> changes;  ///< of velocities
        std::vector<OnWall> on_walls;
        double spared = 0.0;  ///< what dashpots of contacts that ended would have taken beyond their end [J/m]
    };
    const Balance& balance() const { return balance_; }

    /// What the last accepted evaluation ended, began and found.
    struct Turnover {
        std::int64_t born = 0;
        double dropped = 0.0;     ///< energy left in the springs of contacts that a removed wall ended [J/m]
        double hysteresis = 0.0;  ///< energy spent by normal laws [J/m]
        double deepest = 0.0;     ///< overlap of all contacts [m]
        StoredEnergy stored;
    };
    const Turnover& turnover() const { return turnover_; }

    void save(Checkpoint& checkpoint) const;
    void load(const Checkpoint& checkpoint);

private:
    struct Body {
        double inverse_mass, inverse_inertia;
        double radius;  ///< outer [m]
        const Shape* shape;
        MaterialIndex material;
        bool disk;
    };

    void adopt(const Numbering& numbers);
    void place_polygons(std::span<const double> x);
    /// What the normal spring of a contact missed in the step that the last evaluation ended.
    struct Miss {
        std::size_t contact = 0;
        double energy = 0.0;  ///< that it gave up, less its work [J/m]
        double forces = 0.0;  ///< sum of those at both ends [N/m]
    };
    /// What one thread finds in its share of the candidates, and its tools.
    struct Share {
        TouchFinder geometry;
        DampingRatio ratio;
        std::vector<Touch> touches;              ///< of the pair at hand
        std::vector<const SoftContact*> memory;  ///< the old contact that each goes on from, if any
        std::vector<SoftContact> found;
        std::vector<Miss> missed;
        std::size_t cursor = 0;  ///< first old contact that has not been passed
        std::int64_t born = 0;

        void clear() {
            found.clear();
            missed.clear();
            cursor = 0;
            born = 0;
        }
    };

    void find_contacts(std::span<const double> x, std::span<const double> v, std::span<double> forces);
    /// One thread alone finds all.
    void find_alone(std::span<const double> x, std::span<const double> v, std::span<double> forces);
    /// `used` shares are found by several threads.
    void find_together(std::size_t used, std::span<const double> x, std::span<const double> v,
                       std::span<double> forces);
    void meet_walls(Share& share, std::span<const double> x, std::span<const double> v);
    void meet_grains(Share& share, std::span<const GrainPair> pairs, std::span<const double> x,
                     std::span<const double> v);
    void touch_piece(Share& share, std::size_t piece, GrainIndex grain, std::span<const double> x) const;
    /// Contacts of a pair at all its touches.
    void add_contacts(Share& share, BodyIndex a, BodyIndex b, std::span<const double> x, std::span<const double> v);
    void add_contact(Share& share, BodyIndex a, BodyIndex b, const Touch& touch, const SoftContact* old,
                     std::span<const double> x, std::span<const double> v);
    void recall(Share& share, BodyIndex a, BodyIndex b);
    void drop(const SoftContact& contact);
    /// Enters the miss of the contact found last, if it is worth mending; `way` and `old_way`: by which the bodies have
    /// parted along its normal and along that of the old contact [m].
    static void find_miss(Share& share, const SoftContact* old, double way, double old_way);
    /// How far a grain has gone [m] and turned [rad].
    struct Shift {
        Vec2 way = Vec2::Zero();
        double turn = 0.0;
    };
    static Shift shift_of(BodyIndex grain, std::span<const double> from, std::span<const double> to) {
        const std::size_t k = 3 * Grains::at(grain);
        return {{to[k] - from[k], to[k + 1] - from[k + 1]}, to[k + 2] - from[k + 2]};
    }
    /// Way by which the bodies of an old contact have parted along its normal during the time dt [s] since [m]; a
    /// wall's shift is not looked at.
    double way_of(const SoftContact& old, const Shift& a, const Shift& b, std::span<const double> from,
                  double dt) const;
    double way_of(const SoftContact& old, std::span<const double> from, std::span<const double> to, double dt) const {
        const Shift a = is_wall(old.a) ? Shift{} : shift_of(old.a, from, to);
        return way_of(old, a, shift_of(old.b, from, to), from, dt);
    }
    void end_contact(SoftContact& old, double h, std::span<double> v);
    /// The impulse on b that adds the energy [J/m], but at most `most` [N s/m].
    Vec2 balance(const SoftContact& c, std::span<const double> x, double energy, double most, std::span<double> v);
    void push(BodyIndex grain, const Vec2& arm, const Vec2& impulse, std::span<double> v);
    static Vec2 place(std::span<const double> x, BodyIndex grain) {
        const std::size_t k = 3 * Grains::at(grain);
        return {x[k], x[k + 1]};
    }
    /// Velocity of the point at the arm from a grain's centre.
    static Vec2 velocity_at(std::span<const double> v, BodyIndex grain, const Vec2& arm) {
        const std::size_t k = 3 * Grains::at(grain);
        return Vec2(v[k], v[k + 1]) + cross(v[k + 2], arm);
    }
    static double spin_of(std::span<const double> v, BodyIndex grain) { return v[3 * Grains::at(grain) + 2]; }
    double effective_mass(const SoftContact& contact, const Vec2& arm_a, const Vec2& arm_b) const;
    const PairSoftLaw& law_of(BodyIndex a, BodyIndex b) const;
    double restitution_at_birth(BodyIndex a, BodyIndex b) const;
    /// Adds forces [N/m] and torques [N] of contacts, and what they hold.
    void sum_forces(std::span<const SoftContact> contacts, std::span<const double> x, std::span<double> forces);

    const Scene& scene_;
    SoftLaws laws_;
    SoftWalls walls_;
    Candidates candidates_;
    Parallel parallel_;
    std::vector<Share> shares_;  ///< one for each thread
    Numbering numbers_;
    std::vector<Body> bodies_;
    std::vector<Pose> poses_;  ///< of polygons
    bool any_polygon_ = false;
    std::int64_t step_ = 0;

    double time_ = 0.0;  ///< of the evaluation at hand [s]
    std::vector<SoftContact> contacts_, next_;
    std::vector<char> recalled_;                   ///< old contacts that live on
    std::vector<std::size_t> ended_, next_ended_;  ///< old contacts that do not
    std::vector<Miss> missed_, next_missed_;
    Turnover turnover_, next_turnover_;
    Balance balance_;
    std::span<const double> evaluated_x_;  ///< of the evaluation at hand
    double accepted_time_ = 0.0;           ///< [s]
    double weight_ = 0.0;                  ///< [s]
    std::vector<double> accepted_x_, previous_x_;
};

}  // namespace polargrain
