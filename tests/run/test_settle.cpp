#include <gtest/gtest.h>

#include <cmath>

#include "src/core/error.h"
#include "src/run/settle.h"
#include "tests/run/falling_engine.h"

namespace polargrain {
namespace {

std::unique_ptr<Engine> make_falling(const Scene& scene) { return std::make_unique<FallingEngine>(scene); }

TEST(Settle, AGrainLetGoFallsDownFirst) {
    const Scene scene = one_disk(0.3, true);
    const Settled settled = settle(scene, {}, 1e-4, make_falling, {});
    EXPECT_TRUE(settled.at_rest);
    EXPECT_EQ(settled.grains.y[0], 0.0) << "at rest on the floor, not hanging where it was let go";
    EXPECT_NEAR(settled.time, std::sqrt(2.0 * 0.3 / 9.81) + std::sqrt(2.0 * 0.01 / 9.81), 1e-3);
    EXPECT_EQ(settled.energy, 0.0);
}

TEST(Settle, GivesUpAtTheTimeAllowed) {
    const Scene scene = one_disk(100.0, true);
    const Settled settled = settle(scene, {.until_energy = 1e-6, .at_most = 0.1}, 1e-3, make_falling, {});
    EXPECT_FALSE(settled.at_rest);
    EXPECT_NEAR(settled.time, 0.1, 1e-12);
    const double v = 9.81 * 0.1;
    EXPECT_NEAR(settled.energy, 0.5 * v * v / (9.81 * 0.01), 1e-9) << "kinetic energy over m g R_max";
}

TEST(Settle, WallsStandStillAndAllAreThere) {
    Scene scene = one_disk(0.0, true);
    scene.walls[0].motion = SineMotion{.amplitude = 0.01, .frequency = 10.0};
    scene.walls[0].remove_at = 0.0;
    bool looked = false;
    const auto look = [&looked](const Scene& still) {
        looked = true;
        EXPECT_FALSE(still.walls.at(0).moves());
        EXPECT_TRUE(still.walls.at(0).present(1e9));
        return make_falling(still);
    };
    settle(scene, {}, 1e-3, look, {});
    EXPECT_TRUE(looked);
    EXPECT_TRUE(scene.walls[0].moves()) << "the scene itself is left as it was";
}

TEST(Settle, TheEngineRemembers) {
    const Scene scene = one_disk(0.0, true);
    const Settled settled = settle(scene, {}, 1e-3, make_falling, {});
    FallingEngine engine(scene);
    engine.load(settled.engine);
    EXPECT_EQ(engine.steps_taken(), std::lround(settled.time / 1e-3));
}

TEST(Settle, ObeysAStop) {
    const Scene scene = one_disk(1.0, true);
    const std::atomic<bool> stop = true;
    const Settled settled = settle(scene, {}, 1e-3, make_falling, {.stop = &stop, .progress = {}});
    EXPECT_FALSE(settled.at_rest);
    EXPECT_EQ(settled.time, 0.0);
}

TEST(Settle, WithoutGravityIsRefused) {
    Scene scene = one_disk(1.0, true);
    scene.gravity = Vec2::Zero();
    EXPECT_THROW(settle(scene, {}, 1e-3, make_falling, {}), InputError);
}

}  // namespace
}  // namespace polargrain
