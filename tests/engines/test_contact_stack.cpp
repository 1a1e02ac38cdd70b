#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

constexpr double k_side = 0.02;

class Stack : public ::testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(Stack, OfBoxesStandsTenSeconds) {
    const auto [boxes, e] = GetParam();
    Scene scene = testing::empty_scene(e, 0.4);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    const ShapeIndex box = testing::add_rectangle(scene, k_side, k_side);
    for (int k = 0; k < boxes; ++k) scene.add(Grain{box, 0, {0.0, (k + 0.5) * k_side}});
    Running sim(make_contact, scene);
    sim.run(10.0, 1e-3);
    double drift = 0.0;
    for (const double x : sim.world.grains.x) drift = std::max(drift, std::abs(x) / k_side);
    const double top = (sim.world.grains.y.back() + 0.5 * k_side) / (boxes * k_side);
    const double force = -sim.wall_force(0, 1e-3).y() / sim.weight();
    fmt::print("drift {:.5f} side (< 0.01), height {:.5f}, force / weight {:.9f}, KE {:.2g} m g d, rejected {}, ",
               drift, top, force, sim.restlessness(k_side), sim.moves.rejected);
    fmt::print("rises {:.2g} E0\n", sim.ledger.rises / sim.start_energy);
    EXPECT_LT(drift, 0.01);
    EXPECT_GT(top, 1.0);
    EXPECT_LT(top, 1.0015) << "the boxes stand a resting gap of a thousandth apart";
    // Aim 1e-6, which ten boxes keep. Two sweeps a sub-step leave a load wave in twenty: measured 7e-5.
    EXPECT_NEAR(force, 1.0, boxes <= 10 ? 1e-6 : 2e-4);
    EXPECT_LT(sim.restlessness(k_side), 1e-9);
    EXPECT_EQ(sim.moves.rejected, 0);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
}

INSTANTIATE_TEST_SUITE_P(Boxes, Stack, ::testing::Combine(::testing::Values(10, 20), ::testing::Values(0.0, 0.3)));

TEST(BoxRow, SideBySideOnAFloorStaysPutUnderASecondRow) {
    // Aligned corners, and gaps of a tenth of a millimetre between the boxes of a row: nothing may climb or wander.
    Scene scene = testing::empty_scene(0.2, 0.4);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    const ShapeIndex box = testing::add_rectangle(scene, k_side, k_side);
    const double pitch = k_side + 1e-4;
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 10 - row; ++k) {
            scene.add(Grain{box, 0, {(k + 0.5 * row) * pitch, (row + 0.5) * k_side + 1e-5 * (row + 1)}});
        }
    }
    Running sim(make_contact, scene);
    sim.run(3.0, 1e-3);
    double drift = 0.0;
    double tilt = 0.0;
    for (std::size_t k = 0; k < sim.world.grains.x.size(); ++k) {
        drift = std::max(drift, std::abs(sim.world.grains.x[k] - scene.grains.x[k]) / k_side);
        tilt = std::max(tilt, std::abs(sim.world.grains.angle[k]));
    }
    const double force = -sim.wall_force(0, 1e-3).y() / sim.weight();
    fmt::print("drift {:.5f} side, tilt {:.2g}, force / weight {:.9f}, KE {:.2g}, rejected {}\n", drift, tilt, force,
               sim.restlessness(k_side), sim.moves.rejected);
    EXPECT_LT(drift, 0.01);
    EXPECT_LT(tilt, 2e-3);
    EXPECT_NEAR(force, 1.0, 1e-6);
    EXPECT_LT(sim.restlessness(k_side), 1e-9);
    EXPECT_EQ(sim.moves.rejected, 0);
}

}  // namespace
}  // namespace polargrain
