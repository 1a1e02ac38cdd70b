#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "src/core/random.h"
#include "src/engines/contact/contact_engine.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::PourShape;
using testing::Running;

constexpr double k_d = 0.02;

/// Share of moves rejected in each tenth of a second.
std::vector<double> rejected_by_window(Running& sim, double duration, double dt, int& overlaps) {
    std::vector<double> share;
    MoveCount window;
    std::int64_t steps = 0;
    const auto per_window = static_cast<std::int64_t>(std::lround(0.1 / dt));
    sim.run(duration, dt, [&] {
        window += sim.report.moves;
        if (sim.world.step % 50 == 0) {
            overlaps += testing::count_overlaps(sim.scene, sim.world.grains, sim.world.time, 1e-9);
        }
        if (++steps % per_window != 0) return;
        share.push_back(static_cast<double>(window.rejected) / static_cast<double>(window.tried));
        window = {};
    });
    return share;
}

void expect_that_rejection_dies_out(Scene scene, double dt, double duration) {
    Running sim(make_contact, std::move(scene));
    if (dt == 0.0) dt = sim.engine->suggested_dt();
    ASSERT_EQ(testing::count_overlaps(sim.scene, sim.world.grains, 0.0, 1e-9), 0);
    int overlaps = 0;
    const auto share = rejected_by_window(sim, duration, dt, overlaps);
    fmt::print("{} grains, dt {:.3g} (suggested {:.3g}), rejected % by tenths of a second:", sim.world.grains.size(),
               dt, sim.engine->suggested_dt());
    for (const double s : share) fmt::print(" {:.4f}", 100.0 * s);
    fmt::print("; in all {:.5f} %, overlaps {}, rises {:.2g} E0, KE {:.2g} m g d\n", 100.0 * sim.rejected_share(),
               overlaps, sim.ledger.rises / sim.start_energy, sim.restlessness(k_d));
    EXPECT_EQ(overlaps, 0);
    EXPECT_GT(sim.impacts, 500);
    EXPECT_LT(*std::max_element(share.begin(), share.end()), 0.05);
    EXPECT_EQ(share.back(), 0.0);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
}

/// n grains in rows of equal cells above a box; the shape of grain k from `shape(k)`.
template <typename ShapeOf>
Scene rows_of(Scene scene, int n, double width, double cell, std::uint64_t seed, ShapeOf shape) {
    testing::add_box(scene, width, 0.6);
    RandomStream random(seed, RandomPurpose::test);
    const int across = static_cast<int>(width / cell);
    for (int k = 0; k < n; ++k) {
        const int row = k / across;
        scene.add(Grain{shape(k),
                        0,
                        {(k % across + 0.5) * width / across, (row + 0.55) * cell},
                        random.uniform(-k_pi, k_pi),
                        {0.1 * random.normal(), 0.1 * random.normal()}});
    }
    return scene;
}

TEST(Rejection, OfSmoothDisksDoesNotSustainItself) {
    // A crystal of frictionless disks compresses faster than few sweeps can repair: the case that once stayed jammed.
    expect_that_rejection_dies_out(testing::pour(PourShape::disk, 500, 2, 0.3, 0.0), 1e-3, 1.0);
}

TEST(Rejection, OfLongSticksDiesOut) {
    Scene scene = testing::empty_scene(0.3, 0.3);
    const ShapeIndex stick = testing::add_stick(scene, 0.03, 0.003);
    expect_that_rejection_dies_out(rows_of(std::move(scene), 150, 0.25, 0.031, 1, [&](int) { return stick; }), 0.0,
                                   0.7);
}

TEST(Rejection, OfDeepStarsDiesOut) {
    Scene scene = testing::empty_scene(0.3, 0.3);
    const ShapeIndex star = testing::add_star(scene, 0.012, 0.004, 5);
    expect_that_rejection_dies_out(rows_of(std::move(scene), 100, 0.25, 0.0245, 1, [&](int) { return star; }), 0.0,
                                   1.0);
}

/// A few grains of diameter `ratio` times 4 mm on a bed of grains of 4 mm.
Scene mixed_sizes(int ratio, int large, int small) {
    const double d = 0.004;
    Scene scene = testing::empty_scene(0.3, 0.3);
    const ShapeIndex pebble = testing::add_rough(scene, 0.5 * d, 0.15, 1);
    const ShapeIndex boulder = testing::add_rough(scene, 0.5 * d * ratio, 0.15, 2);
    const double width = 40.0 * d;
    scene = rows_of(std::move(scene), small, width, 1.2 * d, 3, [&](int) { return pebble; });
    double top = 0.0;
    for (const double y : scene.grains.y) top = std::max(top, y);
    const double pitch = width / large;
    for (int k = 0; k < large; ++k) {
        scene.add(Grain{boulder, 0, {(k + 0.5) * pitch, top + d + 0.7 * d * ratio}, 1.0 * k});
    }
    return scene;
}

TEST(Rejection, OfSizesOneToTenDiesOut) { expect_that_rejection_dies_out(mixed_sizes(10, 3, 250), 0.0, 0.8); }

TEST(Rejection, OfSizesOneToTwentyDiesOut) { expect_that_rejection_dies_out(mixed_sizes(20, 1, 250), 0.0, 0.8); }

}  // namespace
}  // namespace polargrain
