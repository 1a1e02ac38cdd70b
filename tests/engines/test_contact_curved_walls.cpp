#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

/// Inside of a ring of the radius 0.5 m, of so many pieces, run through counter-clockwise or clockwise.
void add_ring(Scene& scene, int pieces, bool counter_clockwise) {
    std::vector<Vec2> points;
    for (int k = 0; k <= pieces; ++k) {
        const double angle = 2.0 * k_pi * (k % pieces) / pieces;
        points.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle));
    }
    if (!counter_clockwise) std::reverse(points.begin(), points.end());
    testing::add_wall(scene, "ring", points);
}

struct RingCase {
    int pieces;
    double dt;
};

class Ring : public ::testing::TestWithParam<RingCase> {};

// A disk without friction and restitution that slides along the inside keeps cos of its speed at each joint: the
// direction it goes in, and that of the chain, are nothing to it.
TEST_P(Ring, TakesFromASlidingDiskWhatItsJointsTakeInEitherDirection) {
    const auto [pieces, dt] = GetParam();
    constexpr double radius = 0.05;
    for (const bool counter_clockwise : {true, false}) {
        for (const double way : {1.0, -1.0}) {
            Scene scene = testing::empty_scene(0.0, 0.0, 0.0);
            add_ring(scene, pieces, counter_clockwise);
            const double height = 0.5 * std::cos(k_pi / pieces) - radius - 1e-4;
            scene.add(Grain{testing::add_disk(scene, radius), 0, {0.0, -height}, 0.0, {way, 0.0}, 0.0});
            Running sim(make_contact, scene);
            double turned = 0.0;
            Vec2 last = sim.world.grains.position(0);
            sim.run(1.0, dt, [&] {
                const Vec2 now = sim.world.grains.position(0);
                turned += std::atan2(cross(last, now), last.dot(now));
                last = now;
            });
            const double joints = std::abs(turned) * pieces / (2.0 * k_pi);
            const double exact = std::pow(std::cos(2.0 * k_pi / pieces), 2.0 * joints);
            const double kept = sim.world.grains.velocity(0).squaredNorm();
            fmt::print("{} pieces, dt {}, way {}: kept {:.4f} of its energy, {:.0f} joints leave {:.4f}\n", pieces, dt,
                       way, kept, joints, exact);
            EXPECT_NEAR(kept, exact, 0.004);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Pieces, Ring,
                         ::testing::Values(RingCase{60, 5e-3}, RingCase{180, 0.025}, RingCase{180, 5e-3},
                                           RingCase{180, 1e-3}, RingCase{720, 5e-3}, RingCase{720, 1e-3}));

// A square slides along on two corners. There is no closed form; its steps must agree.
TEST(Ring, TakesFromASlidingSquareAsMuchAtEveryStep) {
    const auto kept = [](double dt, double way) {
        Scene scene = testing::empty_scene(0.0, 0.0, 0.0);
        add_ring(scene, 180, true);
        scene.add(Grain{testing::add_rectangle(scene, 0.07, 0.07), 0, {0.0, -0.414}, 0.0, {way, 0.0}, 0.0});
        Running sim(make_contact, scene);
        sim.run(1.0, dt);
        EXPECT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9), 0);
        return energy(sim.world.grains, sim.scene.gravity).kinetic() / sim.start_energy;
    };
    const double fine = kept(5e-4, 1.0);
    for (const double way : {1.0, -1.0}) {
        for (const double dt : {0.0175, 5e-3, 1e-3}) {
            const double coarse = kept(dt, way);
            fmt::print("dt {}, way {}: kept {:.4f}, at 5e-4 s {:.4f}\n", dt, way, coarse, fine);
            EXPECT_NEAR(coarse, fine, 0.05);
        }
    }
}

// Without friction a drum turns its grains by its corners alone, as much one way as the other: of a disk that slides
// past 360 corners, each of one degree, they take m (w R)^2 / 2 x 0.0175 in a radian, 0.004 of its weight times R here.
TEST(SmoothDrum, FeelsTheSameSmallTorqueEitherWay) {
    double torques[2] = {0.0, 0.0};
    for (const int way : {0, 1}) {
        Scene scene = testing::empty_scene(0.3, 0.0);
        add_ring(scene, 360, true);
        scene.walls[0].motion = RotationMotion{{0.0, 0.0}, way == 0 ? 3.0 : -3.0, 0.0};
        const ShapeIndex disk = testing::add_disk(scene, 0.025);
        for (int k = 0; k < 40; ++k) {
            const double side = way == 0 ? 1.0 : -1.0;
            scene.add(Grain{disk, 0, {side * (-0.23 + 0.06 * (k % 8)), -0.2 + 0.06 * (k / 8)}});
        }
        Running sim(make_contact, scene);
        const double dt = sim.engine->suggested_dt();
        sim.run(1.0, dt);
        const double begin = sim.world.time;
        sim.run(3.0, dt, [&] { torques[way] += sim.report.walls[0].angular; });
        torques[way] /= (sim.world.time - begin) * sim.weight() * 0.5;
    }
    fmt::print("mean torque {:.3g} and {:.3g} of weight x radius\n", torques[0], torques[1]);
    EXPECT_LT(std::abs(torques[0]), 0.015);
    EXPECT_NEAR(torques[0], -torques[1], 1.5e-3);
}

}  // namespace
}  // namespace polargrain
