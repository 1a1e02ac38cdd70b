#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "shapes/shape_spec.h"
#include "src/engines/contact/contact_engine.h"
#include "src/theory/domino_chain.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

constexpr double k_g = 9.81;

struct Material {
    std::string name;
    double height, thickness, restitution, friction;
};

std::ostream& operator<<(std::ostream& out, const Material& m) { return out << m.name; }

const Material k_opalene{"opalene", 41.8e-3, 7.5e-3, 0.85, 0.18};
const Material k_perspex{"perspex", 80.0e-3, 9.9e-3, 0.55, 0.25};
const Material k_tufnol{"tufnol", 80.0e-3, 9.6e-3, 0.65, 0.15};

/// Speed of the wave / sqrt(g L), second half of 40 dominoes on a floor with mu 1.5 and e 0.2; gap in thicknesses.
double wave_speed(const Material& m, double gap, double dt, int vertices = 4) {
    Scene scene;
    scene.materials.add({m.name, 1190.0, {m.restitution, 0.0}, m.friction});
    scene.materials.add({"floor", 0.0, {0.2, 0.0}, 1.5});
    scene.materials.set_pair(0, 1, 1.5, polargrain::Restitution{0.2, 0.0});
    scene.gravity = {0.0, -k_g};
    scene.walls.push_back({"floor", 1, {{-1.0, 0.0}, {6.0, 0.0}}, {}, std::nullopt});
    const ShapeIndex plate = scene.add(
        std::make_shared<const Shape>(make_shape("plate", RectangleSpec{m.thickness, m.height, vertices}, 1)));
    const int count = 40;
    const double pitch = m.thickness * (1.0 + gap);
    const double rate = std::sqrt(k_g / m.height);
    for (int k = 0; k < count; ++k) scene.add(Grain{plate, 0, {pitch * k, 0.5 * m.height}});
    scene.grains.spin[0] = -rate;
    scene.grains.vx[0] = 0.5 * rate * m.height;
    Running sim(make_contact, scene);
    std::vector<double> struck(count, -1.0);
    const std::size_t first = count / 2;
    const std::size_t last = count - 2;
    while (sim.world.time < 6.0 && struck[last] < 0.0) {
        sim.step(dt);
        for (std::size_t k = 0; k < struck.size(); ++k) {
            if (struck[k] < 0.0 && sim.world.grains.spin[k] < -0.02 * rate) struck[k] = sim.world.time;
        }
    }
    EXPECT_GE(struck[last], 0.0) << "the wave must reach the end";
    EXPECT_EQ(sim.moves.rejected, 0);
    EXPECT_LT(sim.ledger.rises, 1e-9 * sim.start_energy);
    return pitch * static_cast<double>(last - first) / (struck[last] - struck[first]) / std::sqrt(k_g * m.height);
}

double chain_speed(const Material& m, double gap) {
    const double h = m.thickness / m.height;
    // At three times the step of the table; it moves no speed by more than half a percent.
    return pinned_chain_speed({h, gap * h, m.restitution, m.friction}, 70, 3e-4);
}

class Dominoes : public ::testing::TestWithParam<std::tuple<Material, int>> {};

TEST_P(Dominoes, FallAsFastAsThePinnedChain) {
    const auto& [material, gap] = GetParam();
    const double coarse = wave_speed(material, gap, 1e-3);
    const double fine = wave_speed(material, gap, 3e-4);
    const double chain = chain_speed(material, gap);
    fmt::print("{} gap {} h: dt 1e-3 {:.4f} ({:+.2f} %), 3e-4 {:.4f} ({:+.2f} %), chain {:.4f}\n", material.name, gap,
               coarse, 100.0 * (coarse / chain - 1.0), fine, 100.0 * (fine / chain - 1.0), chain);
    EXPECT_NEAR(coarse / chain, 1.0, 0.04);
    EXPECT_NEAR(fine / chain, 1.0, 0.04);
    // Aim 1 %, which gaps of two thicknesses and more keep. The wave of a row one thickness apart is faster than one
    // domino in six steps of 1e-3 s; measured 2.9 % (Perspex), 2.6 % (Tufnol), 1.3 % (Opalene).
    EXPECT_NEAR(coarse / fine, 1.0, gap == 1 ? 0.035 : 0.01);
}

std::string case_name(const ::testing::TestParamInfo<std::tuple<Material, int>>& c) {
    return fmt::format("{}_{}", std::get<0>(c.param).name, std::get<1>(c.param));
}

INSTANTIATE_TEST_SUITE_P(HardPlastics, Dominoes,
                         ::testing::Combine(::testing::Values(k_perspex, k_tufnol), ::testing::Range(1, 6)), case_name);
INSTANTIATE_TEST_SUITE_P(Opalene, Dominoes, ::testing::Combine(::testing::Values(k_opalene), ::testing::Range(1, 3)),
                         case_name);

class WideOpalene : public ::testing::TestWithParam<int> {};

TEST_P(WideOpalene, FallsBetweenTheTwoTheories) {
    // Aim: the chain within 4 %. Its pairwise impacts at e = 0.85 hand on speed that a group of leaning dominoes, which
    // the engine resolves, damps: the group theory with friction is the other bound.
    const std::vector<double> group = {1.283, 1.177, 0.977};
    const int gap = GetParam();
    const double coarse = wave_speed(k_opalene, gap, 1e-3);
    const double fine = wave_speed(k_opalene, gap, 3e-4);
    const double chain = chain_speed(k_opalene, gap);
    const double bound = group[static_cast<std::size_t>(gap - 3)];
    fmt::print("opalene gap {} h: dt 1e-3 {:.4f} ({:+.2f} %), 3e-4 {:.4f} ({:+.2f} %), chain {:.4f}, group {:.3f}\n",
               gap, coarse, 100.0 * (coarse / chain - 1.0), fine, 100.0 * (fine / chain - 1.0), chain, bound);
    for (const double speed : {coarse, fine}) {
        EXPECT_GT(speed, bound);
        EXPECT_LT(speed, chain);
    }
}

INSTANTIATE_TEST_SUITE_P(Gaps, WideOpalene, ::testing::Values(3, 4, 5));

TEST(Dominoes, WithVerticesAlongTheirSidesFallAlike) {
    const double plain = wave_speed(k_perspex, 2, 3e-4, 4);
    const double divided = wave_speed(k_perspex, 2, 3e-4, 24);
    fmt::print("4 vertices {:.4f}, 24 vertices {:.4f} ({:+.2f} %)\n", plain, divided, 100.0 * (divided / plain - 1.0));
    EXPECT_NEAR(divided / plain, 1.0, 0.01);
}

}  // namespace
}  // namespace polargrain
