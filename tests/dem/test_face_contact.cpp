#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "src/engines/dem/normal_law.h"
#include "tests/dem/dem_runs.h"

namespace polargrain {
namespace {

using testing::Running;

struct FaceCase {
    double elastic;  ///< [N/m]
    double closing;  ///< [m/s]
    double spin;     ///< [rad/s]
    bool tension;
};

// A part of the face at the station s gets its share of the spring and closes by spin x s more than the middle.
TEST(DampedFace, IsTheSumOverItsPartsOfWhichNoneIsPulled) {
    constexpr double width = 0.2;
    constexpr double damping = 30.0;
    constexpr int parts = 200000;
    const FaceCase cases[] = {{5.0, 0.1, 1.0, false},  {5.0, 0.1, -1.0, true},  {5.0, 0.0, 4.0, false},
                              {5.0, 0.0, -4.0, false}, {5.0, -0.3, 4.0, false}, {5.0, -0.3, 4.0, true},
                              {0.5, 2.0, 20.0, false}, {5.0, -2.0, 4.0, false}, {5.0, -0.1, 0.0, false}};
    for (const auto& [elastic, closing, spin, tension] : cases) {
        double force = 0.0;
        double moment = 0.0;
        for (int k = 0; k < parts; ++k) {
            const double s = ((k + 0.5) / parts - 0.5) * width;
            const double share = (elastic + damping * (closing + spin * s)) / parts;
            const double push = tension ? share : std::fmax(0.0, share);
            force += push;
            moment -= s * push;
        }
        const FaceForce face = damped_face(elastic, damping, closing, spin, width, tension);
        EXPECT_NEAR(face.force, force, 1e-8 * (elastic + damping));
        EXPECT_NEAR(face.moment, moment, 1e-8 * (elastic + damping) * width);
    }
}

TEST(DampedFace, OfNoWidthIsADampedPoint) {
    for (const double closing : {-2.0, -0.1, 0.0, 0.5}) {
        const FaceForce face = damped_face(5.0, 30.0, closing, 3.0, 0.0, false);
        EXPECT_EQ(face.force, damped_force(5.0, 30.0, closing, false));
        EXPECT_EQ(face.moment, 0.0);
    }
}

/// Peaks over the angle of the diagonal [rad] of a block of 0.1 x 0.4 m, let go at half that angle on a floor of great
/// friction, at the default softness.
std::vector<double> rocking_peaks(double restitution, double seconds) {
    const double alpha = std::atan2(0.1, 0.4);
    const double half_diagonal = 0.5 * std::hypot(0.1, 0.4);
    Scene scene = testing::empty_scene(restitution, 3.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.1, 0.4),
                    0,
                    {-half_diagonal * std::sin(0.5 * alpha), half_diagonal * std::cos(0.5 * alpha)},
                    -0.5 * alpha});
    Running sim(testing::make_default_dem, scene);
    std::vector<double> peaks;
    double last_spin = 0.0;
    sim.run(seconds, 1e-3, [&] {
        const double spin = sim.world.grains.spin[0];
        const double angle = std::abs(sim.world.grains.angle[0]);
        if (last_spin * spin < 0.0 && angle > 0.05 * alpha) peaks.push_back(angle / alpha);
        last_spin = spin;
    });
    EXPECT_LT(std::abs(sim.ledger.created), 1e-6 * sim.start_energy);
    return peaks;
}

// Housner's block, without restitution: 1 - 1.5 sin^2(alpha) of its spin after each impact.
TEST(SoftRockingBlock, LosesWhatARigidOneDoes) {
    const std::vector<double> peaks = rocking_peaks(0.0, 1.5);
    ASSERT_GE(peaks.size(), 3U);
    fmt::print("peaks {:.4f} {:.4f} {:.4f} (0.3867 0.3064 0.2461)\n", peaks[0], peaks[1], peaks[2]);
    EXPECT_NEAR(peaks[0], 0.38671, 0.015);
    EXPECT_NEAR(peaks[1], 0.30640, 0.015);
    EXPECT_NEAR(peaks[2], 0.24606, 0.015);
}

TEST(SoftRockingBlock, LosesLessWhereMoreIsGivenBack) {
    const std::vector<double> half = rocking_peaks(0.5, 0.8);
    const std::vector<double> none = rocking_peaks(0.0, 0.8);
    ASSERT_FALSE(half.empty());
    EXPECT_GT(half[0], none[0] + 0.03);
    EXPECT_LT(half[0], 0.49);
}

// One of them spins: the dashpots of the faces hand its spin over, as one impulse to both.
TEST(FaceToFace, KeepsMomentumLinearAndAngular) {
    Scene scene = testing::empty_scene(0.1, 0.3, 0.0);
    const ShapeIndex square = testing::add_rectangle(scene, 0.1, 0.1);
    scene.add(Grain{square, 0, {0.0, 0.0}, 0.0, {0.5, 0.1}, 0.0});
    scene.add(Grain{square, 0, {0.102, 0.03}, 0.01, {-0.5, 0.0}, -2.0});
    Running sim(testing::make_default_dem, scene);
    const Vec2 linear = testing::momentum(sim.world.grains);
    const double angular = testing::angular_momentum(sim.world.grains);
    sim.run(0.1, 1e-3);
    ASSERT_GT(sim.impacts, 0);
    EXPECT_NE(sim.world.grains.spin[0], 0.0);
    EXPECT_LT((testing::momentum(sim.world.grains) - linear).norm(), 1e-12);
    EXPECT_NEAR(testing::angular_momentum(sim.world.grains), angular, 1e-12);
}

// Without gravity nothing but the floor changes the momentum of a plate that strikes it flat and spinning.
TEST(FaceOnAWall, GivesTheWallTheTorqueThatTheGrainLost) {
    Scene scene = testing::empty_scene(0.3, 0.4, 0.0);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.add(Grain{testing::add_rectangle(scene, 0.2, 0.05), 0, {0.3, 0.0262}, 0.0, {0.2, -1.0}, 1.0});
    Running sim(testing::make_default_dem, scene);
    const double before = testing::angular_momentum(sim.world.grains);
    double on_wall = 0.0;
    sim.run(0.05, 1e-3, [&] { on_wall += sim.report.walls[0].angular; });
    const double lost = before - testing::angular_momentum(sim.world.grains);
    ASSERT_GT(sim.impacts, 0);
    EXPECT_GT(std::abs(lost), 1.0);
    EXPECT_NEAR(on_wall, lost, 1e-9 * std::abs(before));
}

}  // namespace
}  // namespace polargrain
