#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/core/random.h"
#include "src/engines/contact/contact_engine.h"
#include "src/engines/contact/face_blow.h"
#include "src/engines/contact/gap_motion.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

/// Contact of i with j at a point, of bodies at the origin and at (0, -1), normal upwards but for a tilt.
GapContact contact_at(double x, double tilt, double friction) {
    GapContact c;
    c.i = 0;
    c.j = 1;
    c.normal = {std::sin(tilt), std::cos(tilt)};
    c.point = {x, -0.5};
    c.friction = friction;
    const Vec2 arm_i = c.point;
    const Vec2 arm_j = c.point - Vec2(0.0, -1.0);
    c.arm_ni = cross(arm_i, c.normal);
    c.arm_ti = cross(arm_i, c.tangent());
    c.arm_nj = cross(arm_j, c.normal);
    c.arm_tj = cross(arm_j, c.tangent());
    return c;
}

double kinetic(const std::vector<SolverBody>& bodies) {
    double sum = 0.0;
    for (const SolverBody& b : bodies) {
        sum += 0.5 * b.velocity.squaredNorm() / b.inverse_mass + 0.5 * b.spin * b.spin / b.inverse_inertia;
    }
    return sum;
}

TEST(FaceBlow, KeepsTheRelativeSpinWhilePressedAtBothEndsAndTakesWhatItSays) {
    RandomStream random(5, RandomPurpose::test);
    int pressed = 0;
    int tipped = 0;
    for (int n = 0; n < 2000; ++n) {
        const double friction = random.uniform(0.0, 0.8);
        const double e = random.uniform();
        const GapContact first = contact_at(random.uniform(-0.5, 0.0), random.uniform(-0.005, 0.005), friction);
        const GapContact second = contact_at(random.uniform(0.05, 0.5), random.uniform(-0.005, 0.005), friction);
        std::vector<SolverBody> bodies(2);
        for (SolverBody& b : bodies) {
            b.velocity = {random.uniform(-2.0, 2.0), 0.0};
            b.inverse_mass = random.uniform(0.2, 2.0);
            b.inverse_inertia = random.uniform(2.0, 20.0);
        }
        bodies[0].velocity.y() = -1.0;
        bodies[0].spin = bodies[1].spin = random.uniform(-0.5, 0.5);
        const double energy = kinetic(bodies);
        const double spin = bodies[0].spin - bodies[1].spin;
        const FaceBlow blow = solve_face_blow(first, second, bodies, e);
        const double part = blow.of_second;
        push(first, bodies, (1.0 - part) * blow.result.normal, (1.0 - part) * blow.result.tangential);
        push(second, bodies, part * blow.result.normal, part * blow.result.tangential);
        EXPECT_NEAR(energy - kinetic(bodies), blow.result.restitution_loss + blow.result.friction_loss, 1e-12);
        EXPECT_GE(blow.result.restitution_loss, 0.0);
        EXPECT_GE(blow.result.friction_loss, -1e-12);
        EXPECT_LE(std::abs(blow.result.tangential), friction * blow.result.normal * (1.0 + 1e-12));
        if (part > 0.0 && part < 1.0) {
            EXPECT_NEAR(bodies[0].spin - bodies[1].spin, spin, 1e-12);
            ++pressed;
        } else {
            ++tipped;
        }
    }
    EXPECT_GT(pressed, 500);
    EXPECT_GT(tipped, 100);
}

struct Landing {
    double restitution, friction, along;  ///< along: speed past the floor [m/s]
};

class FlatLanding : public ::testing::TestWithParam<Landing> {};

// A block that lands flat is a point mass to the floor: its face holds it level, as long as friction, mu (1 + e) of its
// speed at half its height below its centre, does not tip it.
TEST_P(FlatLanding, ThrowsABlockBackWithoutSpin) {
    const auto [e, mu, along] = GetParam();
    for (const int vertices : {4, 24}) {
        for (const double dt : {4e-3, 1e-3}) {
            Scene scene = testing::empty_scene(e, mu, 0.0);
            testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
            const ShapeIndex block = testing::add_rectangle(scene, 0.04, 0.02, vertices);
            scene.add(Grain{block, 0, {-0.5, 0.06}, 0.0, {along, -1.0}, 0.0});
            Running sim(make_contact, scene);
            sim.run(0.1, dt);
            const double slid = std::min(std::abs(along), mu * (1.0 + e));
            EXPECT_NEAR(sim.world.grains.vy[0], e, 1e-9);
            EXPECT_NEAR(sim.world.grains.spin[0], 0.0, 1e-9);
            EXPECT_NEAR(sim.world.grains.vx[0], along - std::copysign(slid, along), 1e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Blocks, FlatLanding,
                         ::testing::Values(Landing{1.0, 0.0, 0.0}, Landing{1.0, 0.3, 0.0}, Landing{0.5, 0.3, 0.0},
                                           Landing{0.8, 0.3, 2.0}, Landing{0.5, 0.3, -2.0}, Landing{0.0, 0.3, 1.0},
                                           Landing{0.6, 0.5, 0.3}));

TEST(FlatLanding, OfASquareOnASquareKeepsBothLevel) {
    Scene scene = testing::empty_scene(0.7, 0.2, 0.0);
    const ShapeIndex square = testing::add_rectangle(scene, 0.1, 0.1);
    scene.add(Grain{square, 0, {0.0, 0.0}, 0.0, {0.0, 0.0}, 0.0});
    scene.add(Grain{square, 0, {-0.13, 0.01}, 0.0, {1.0, 0.0}, 0.0});
    Running sim(make_contact, scene);
    sim.run(0.2, 1e-3);
    // Their centres are 0.01 m apart across the way: they part level with one another, turning together.
    EXPECT_LT(sim.world.grains.spin[0], -0.5);
    EXPECT_NEAR(sim.world.grains.spin[0], sim.world.grains.spin[1], 1e-9);
    EXPECT_NEAR(sim.world.grains.vx[0] + sim.world.grains.vx[1], 1.0, 1e-12);
}

// Pushed above its middle by a face it slides along, a tall block tips: the face is pressed at one end only.
TEST(FlatLanding, OfATallBlockWithMuchFrictionTipsIt) {
    Scene scene = testing::empty_scene(0.0, 1.0, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.1), 0, {-0.5, 0.06}, 0.0, {3.0, -1.0}, 0.0});
    Running sim(make_contact, scene);
    sim.run(0.015, 1e-3);
    EXPECT_LT(sim.world.grains.spin[0], -1.0);
}

}  // namespace
}  // namespace polargrain
