#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/observe/bed.h"
#include "src/observe/free_surface.h"
#include "tests/dem/dem_runs.h"

namespace polargrain {
namespace {

using testing::Running;

struct Packing {
    double friction;
    double fraction_from, fraction_to;    ///< area fraction under the top
    double potential_from, potential_to;  ///< potential energy over that of the hexagonal packing
};

class SoftPour : public ::testing::TestWithParam<Packing> {};

TEST_P(SoftPour, PacksFiveHundredDisksAsSoftSpheresDo) {
    const Packing& asked = GetParam();
    const int seeds = 4;
    double fraction = 0.0;
    double potential = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Running sim(testing::make_default_dem, testing::pour(testing::PourShape::disk, 500, seed, 0.8, asked.friction));
        sim.run(1.5, 1e-3);
        const auto& disk = std::get<Disk>(sim.scene.shape_of(0));
        const double one = area_fraction(sim.scene, sim.world.grains);
        const double height = potential_over_hexagonal(sim.scene, sim.world.grains);
        fmt::print(
            "friction {} seed {}: area fraction {:.4f}, potential {:.4f}, made by the scheme {:.2g} of the energy\n",
            asked.friction, seed, one, height, sim.ledger.created / sim.start_energy);
        EXPECT_LT(std::abs(sim.ledger.created), 1e-6 * sim.start_energy);
        EXPECT_LT(sim.restlessness(2.0 * disk.radius()), 1e-4);
        fraction += one / seeds;
        potential += height / seeds;
    }
    fmt::print("friction {}: mean {:.4f} ({} to {}), {:.4f} ({} to {})\n", asked.friction, fraction,
               asked.fraction_from, asked.fraction_to, potential, asked.potential_from, asked.potential_to);
    EXPECT_GT(fraction, asked.fraction_from);
    EXPECT_LT(fraction, asked.fraction_to);
    EXPECT_GT(potential, asked.potential_from);
    EXPECT_LT(potential, asked.potential_to);
}

// Three other soft-sphere programs: 0.870 and 1.012 to 1.024 without friction, 0.82 to 0.85 and 1.049 to 1.082 with
// 0.3. Equal disks crystallise more or less: one pour differs from another by a hundredth.
INSTANTIATE_TEST_SUITE_P(Frictions, SoftPour,
                         ::testing::Values(Packing{0.0, 0.86, 0.88, 1.012, 1.024},
                                           Packing{0.3, 0.82, 0.85, 1.049, 1.082}),
                         [](const auto& c) { return c.param.friction > 0.0 ? "with_friction" : "without_friction"; });

}  // namespace
}  // namespace polargrain
