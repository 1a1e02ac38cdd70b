#pragma once

#include <box2d/box2d.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "shapes/convex_pieces.h"
#include "src/model/contact.h"
#include "src/model/engine_settings.h"
#include "src/model/scene.h"

namespace polargrain {

/// What a contact point needs to be known again in another world of the same scene: both fixtures and their parts by
/// our own numbers, and the features that meet.
using PointKey = std::array<std::int64_t, 5>;

/// Impulses that Box2D begins its next step with, in its own units.
struct WarmStart {
    PointKey key{};
    double normal = 0.0, tangent = 0.0;
};

/// What one contact point did in a step: a pushes b.
struct PointImpulse {
    BodyIndex a = 0, b = 0;             ///< a < b
    Vec2 point_before = Vec2::Zero();   ///< where the impulse acted, at the poses at which the step began [m]
    Vec2 normal_before = Vec2::Zero();  ///< unit, out of a into b, at those poses
    Vec2 point = Vec2::Zero();          ///< at the end of the step [m]
    Vec2 normal = Vec2::Zero();         ///< at the end of the step
    double gap = 0.0;                   ///< of the outlines at the end of the step [m]
    double along_normal = 0.0;          ///< on b [N s/m]
    double along_tangent = 0.0;         ///< on b, along (n_y, -n_x) [N s/m]

    Vec2 impulse() const {
        return along_normal * normal_before + along_tangent * Vec2(normal_before.y(), -normal_before.x());
    }
};

/// How lengths are measured, and what Box2D is told beside the scene.
struct BoxSetup {
    double unit = 1.0;  ///< [m] of one of Box2D's units
    Box2dSettings settings;
    std::vector<std::vector<ConvexPiece>> pieces;  ///< of each shape of the scene [m]; none for a disk
};

/// The scene as bodies in a world of Box2D's, with the listener that sets pair laws and takes down impulses.
class BoxWorld final : private b2ContactListener {
public:
    /// Grains as given, walls as they are at the time. warm_starts: sorted by key, for the first step.
    BoxWorld(const Scene& scene, const BoxSetup& setup, const Grains& grains, double time, double dt,
             std::vector<WarmStart> warm_starts);
    BoxWorld(const BoxWorld&) = delete;
    BoxWorld& operator=(const BoxWorld&) = delete;

    /// From time to time + dt.
    void step(double time, double dt);

    void give(Grains& grains) const;
    /// Of the last step, in the order in which Box2D reported them.
    const std::vector<PointImpulse>& impulses() const { return impulses_; }
    /// What the next step will begin with, sorted by key.
    std::vector<WarmStart> warm_starts();
    /// Velocity of a wall's material at a point during the last step [m/s].
    Vec2 wall_velocity(int wall, const Vec2& point) const;
    /// The first grain that has been cut off at Box2D's limits in the last step, or -1.
    GrainIndex cut_off(double dt) const;

private:
    void BeginContact(b2Contact* contact) override;
    void PreSolve(b2Contact* contact, const b2Manifold* old) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

    void add_wall(int wall, double time);
    void add_grain(const Grains& grains, GrainIndex k);
    void add_closed_chain(b2Body* body, std::vector<b2Vec2> points, std::uintptr_t number);
    void add_open_chain(b2Body* body, const std::vector<b2Vec2>& points, std::uintptr_t number);
    b2Fixture* add_fixture(b2Body* body, const b2Shape& shape, std::uintptr_t number) const;
    void place_walls(double time, double dt);
    void remember_poses();
    /// Below everything, falling, and soon too fast for Box2D.
    bool has_fallen(GrainIndex k, double dt) const;
    /// Takes such grains out of Box2D's hands: nothing is left that they could hit.
    void let_go_of_fallen(double dt);
    void fly_fallen(double dt);
    const b2Transform& pose_before(BodyIndex body) const;

    b2Vec2 to_units(const Vec2& v) const {
        return {static_cast<float>(v.x() / setup_.unit), static_cast<float>(v.y() / setup_.unit)};
    }
    Vec2 to_metres(const b2Vec2& v) const {
        return {static_cast<double>(v.x) * setup_.unit, static_cast<double>(v.y) * setup_.unit};
    }

    const Scene& scene_;
    const BoxSetup& setup_;
    float threshold_ = 0.0F;  ///< of restitution [units/s]
    b2World world_;
    std::vector<b2Body*> walls_;               ///< null where a wall is gone
    std::vector<b2Body*> bodies_;              ///< of grains
    std::vector<std::uintptr_t> first_piece_;  ///< number of a wall's first fixture
    std::uintptr_t fixtures_ = 0;              ///< number of the next grain's
    double lowest_ = 0.0;                      ///< height of the lowest wall point or grain at time zero [m]
    std::vector<b2Transform> walls_before_, bodies_before_;
    std::vector<WarmStart> first_guesses_;  ///< empty after the first step
    std::vector<PointImpulse> impulses_;
};

}  // namespace polargrain
