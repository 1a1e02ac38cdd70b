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

constexpr double k_centres[] = {0.0, -1.0};  ///< y of the two bodies

Footing free_at(const SolverBody& body, int which) { return {body, Vec2(0.0, k_centres[which])}; }

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
        const FaceBlow blow = solve_face_blow(first, second, free_at(bodies[0], 0), free_at(bodies[1], 1), e);
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

double kinetic(const Footing& footing, const SolverBody& body, const Vec2& centre) {
    return 0.5 * footing.velocity_at(centre).squaredNorm() / body.inverse_mass +
           0.5 * footing.spin() * footing.spin() / body.inverse_inertia;
}

SolverBody body_of(double mass, double inertia) {
    SolverBody body;
    body.inverse_mass = 1.0 / mass;
    body.inverse_inertia = 1.0 / inertia;
    return body;
}

// The lower of the two stands on a foot, turns about it, and the upper one turns with it while the face is pressed.
TEST(FaceBlow, OfABodyThatStandsOnAFootKeepsTheRelativeSpinAndTakesWhatItSays) {
    RandomStream random(6, RandomPurpose::test);
    int pressed = 0;
    for (int n = 0; n < 2000; ++n) {
        const double friction = random.uniform(0.0, 0.8);
        const double e = random.uniform();
        const GapContact first = contact_at(random.uniform(-0.5, 0.0), 0.0, friction);
        const GapContact second = contact_at(random.uniform(0.05, 0.5), 0.0, friction);
        GapContact on_floor;
        on_floor.i = 1;
        on_floor.j = wall_body(0);
        on_floor.point = {random.uniform(-0.5, 0.5), -1.5};
        on_floor.friction = 0.5;
        SolverBody upper = body_of(random.uniform(0.5, 5.0), random.uniform(0.05, 0.5));
        upper.velocity = {random.uniform(-2.0, 2.0), -1.0};
        const SolverBody lower = body_of(random.uniform(0.5, 5.0), random.uniform(0.05, 0.5));
        for (const Grip grip : {Grip::holds, Grip::slips_back, Grip::slips_ahead}) {
            Footing i = free_at(upper, 0);
            Footing j(lower, Vec2(0.0, k_centres[1]), on_floor, grip);
            const FaceBlow blow = solve_face_blow(first, second, i, j, e);
            SharedImpact(first, second, i, j, blow.of_second).push(blow.result, i, j);
            const Vec2 foot = j.velocity_at(on_floor.point);
            EXPECT_NEAR(foot.y(), 0.0, 1e-12) << "the floor holds it up";
            if (grip == Grip::holds) {
                EXPECT_NEAR(foot.x(), 0.0, 1e-12);
            }
            const double taken = 0.5 * upper.velocity.squaredNorm() / upper.inverse_mass -
                                 kinetic(i, upper, {0.0, k_centres[0]}) - kinetic(j, lower, {0.0, k_centres[1]});
            const double booked =
                blow.result.restitution_loss + blow.result.friction_loss + j.restitution_loss() + j.friction_loss();
            EXPECT_NEAR(taken, booked, 1e-11);
            if (j.is_consistent()) {
                EXPECT_GE(blow.result.restitution_loss, 0.0);
            }
            if (blow.of_second <= 0.0 || blow.of_second >= 1.0) continue;
            EXPECT_NEAR(i.spin(), j.spin(), 1e-11);
            pressed += grip == Grip::holds;
        }
    }
    EXPECT_GT(pressed, 500);
}

TEST(SharedImpact, AtOneContactOfFreeBodiesIsThatOfThePair) {
    RandomStream random(7, RandomPurpose::test);
    for (int n = 0; n < 500; ++n) {
        const GapContact c = contact_at(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(0.0, 0.8));
        std::vector<SolverBody> bodies{body_of(random.uniform(0.5, 5.0), random.uniform(0.05, 0.5)),
                                       body_of(random.uniform(0.5, 5.0), random.uniform(0.05, 0.5))};
        bodies[0].velocity = {random.uniform(-2.0, 2.0), -1.0};
        bodies[1].spin = random.uniform(-1.0, 1.0);
        const ContactFrame frame =
            contact_frame(c.normal, c.point, {bodies[0].inverse_mass, bodies[0].inverse_inertia},
                          c.point - Vec2(0.0, k_centres[1]), {bodies[1].inverse_mass, bodies[1].inverse_inertia});
        const ImpactResult pair =
            solve_impact(frame, {tangent_speed(c, bodies), normal_speed(c, bodies)}, c.friction, 0.6);
        const ImpactResult shared =
            SharedImpact(c, c, free_at(bodies[0], 0), free_at(bodies[1], 1), 0.0).solve(0.6, false);
        EXPECT_NEAR(shared.normal, pair.normal, 1e-12);
        EXPECT_NEAR(shared.tangential, pair.tangential, 1e-12);
        EXPECT_EQ(shared.mode, pair.mode);
    }
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

Vec2 turned(double angle, const Vec2& v) {
    return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

/// Two squares of side 0.02 that fly into one another at 1 m/s, the upper one `offset` beside the lower, all of it
/// turned.
Running flush_squares(double offset, double angle) {
    const auto turn = [angle](const Vec2& v) { return turned(angle, v); };
    Scene scene = testing::empty_scene(1.0, 0.0, 0.0);
    const ShapeIndex square = testing::add_rectangle(scene, 0.02, 0.02);
    scene.add(Grain{square, 0, turn(Vec2(0.0, 0.0)), angle, turn(Vec2(0.0, 0.5)), 0.0});
    scene.add(Grain{square, 0, turn(Vec2(offset, 0.0503)), angle, turn(Vec2(0.0, -0.5)), 0.0});
    Running sim(make_contact, scene);
    sim.run(0.08, 1e-3);
    return sim;
}

// However nearly flush their corners are, and by whichever name a corner on a corner is found.
TEST(FlatLanding, OfFlushSquaresIsOneBlowWhereTheirFacesOverlap) {
    const double side = 0.02;
    const double mass = 1000.0 * side * side;
    const double inertia = mass * side * side / 6.0;
    for (const double offset : {0.0, 1e-16, 1e-6, 1e-5, 2.3e-5, 2.6e-5, 1e-4, -1e-5, 3e-3}) {
        for (const double angle : {0.0, 0.4, 1.1, 2.9, 5.5}) {
            const Running sim = flush_squares(offset, angle);
            const double a = 0.5 * offset;  // the overlap's middle, from each centre
            const double impulse = 2.0 / (2.0 / mass + 2.0 * a * a / inertia);
            for (int k = 0; k < 2; ++k) {
                EXPECT_NEAR(sim.world.grains.spin[static_cast<std::size_t>(k)], -impulse * a / inertia, 1e-9)
                    << offset << " " << angle;
            }
        }
    }
}

// Seen from both sides alike, it can be thrown neither way, though the slab's feet are at its ends.
TEST(FlatLanding, OfABlockOnWhatLiesOnAFloorKeepsItLevel) {
    for (const double width : {0.02, 0.2}) {
        for (const double e : {0.0, 0.5, 1.0}) {
            for (const double mu : {0.0, 0.3}) {
                Scene scene = testing::empty_scene(e, mu, 9.81);
                testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
                scene.add(Grain{testing::add_rectangle(scene, width, 0.02), 0, {0.0, 0.01002}, 0.0, {0.0, 0.0}, 0.0});
                scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.0, 0.05014}, 0.0, {0.0, -0.5}, 0.0});
                Running sim(make_contact, scene);
                sim.run(0.06, 1e-3);
                for (std::size_t k = 0; k < 2; ++k) {
                    EXPECT_NEAR(sim.world.grains.spin[k], 0.0, 1e-5) << width << " " << e << " " << mu;
                    EXPECT_NEAR(sim.world.grains.vx[k], 0.0, 2e-5) << width << " " << e << " " << mu;
                }
            }
        }
    }
}

// Plastic impacts without gravity: what the law leaves of the closing speeds is round-off, and is not struck again.
TEST(Impacts, WithoutGravityAreNoneOfRoundOff) {
    Scene scene = testing::empty_scene(0.0, 0.3, 0.0);
    const ShapeIndex square = testing::add_rectangle(scene, 0.02, 0.02);
    const auto turn = [](const Vec2& v) { return turned(0.73, v); };
    scene.add(Grain{square, 0, {0.0, 0.0}, 0.73, turn(Vec2(0.0, 0.5)), 0.0});
    scene.add(Grain{square, 0, turn(Vec2(0.004, 0.0503)), 0.73, turn(Vec2(0.0, -0.5)), 0.0});
    Running sim(make_contact, scene);
    sim.run(0.06, 1e-3);
    EXPECT_GE(sim.impacts, 1);
    EXPECT_LT(sim.impacts, 40);
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
