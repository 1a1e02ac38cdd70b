#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "tests/scenarios/scenario_text.h"
#include "tests/support/scenes.h"

namespace polargrain::testing {
namespace {

using ::testing::HasSubstr;

constexpr double k_radius = 0.01;

/// A box 1 m wide with a fill in it.
std::string box_with(const std::string& fill, const std::string& head = "") {
    return head + R"(
[materials.stone]
density = 2500.0
restitution = 0.3
friction = 0.2
[shapes.disk]
type = "disk"
radius = 0.01
[shapes.stick]
type = "stick"
length = 0.04
width = 0.01
[shapes.star]
type = "star"
radius = 0.015
inner_radius = 0.006
[[walls]]
name = "box"
material = "stone"
points = [[0.0, 3.0], [0.0, 0.0], [1.0, 0.0], [1.0, 3.0]]
[[fill]]
material = "stone"
)" + fill;
}

std::string fill_of(int count, double height, const std::string& more) {
    return fmt::format("count = {}\nregion = [[0, 0], [1, {}]]\n{}\n", count, height, more);
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
    const double middle = mean(values);
    double sum = 0.0;
    for (const double v : values) sum += (v - middle) * (v - middle);
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::vector<double> size_factors(const Scene& scene) {
    std::vector<double> factors;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) factors.push_back(outer_radius(scene.shape_of(k)) / k_radius);
    return factors;
}

void expect_clear(const Scene& scene) {
    EXPECT_EQ(count_overlaps(scene, scene.grains, 0.0, 1e-12), 0);
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const Vec2 p = scene.grains.position(k);
        EXPECT_TRUE(p.x() > 0.0 && p.x() < 1.0 && p.y() > 0.0) << "grain " << k << " left the box";
    }
}

/// Area fractions from loose to close to the densest packing of disks, 0.9069.
class Density : public ::testing::TestWithParam<double> {};

TEST_P(Density, NoTwoGrainsOverlapAndAllAreThere) {
    constexpr int k_count = 1000;
    const double height = k_count * 3.14159265358979 * k_radius * k_radius / GetParam();
    const Scene scene = load_text(box_with(fill_of(k_count, height, "shapes = [\"disk\"]"))).scene;
    EXPECT_EQ(scene.grains.size(), k_count);
    expect_clear(scene);
    for (const double y : scene.grains.y) EXPECT_LE(y, height - k_radius * (1.0 - 1e-12));
}

INSTANTIATE_TEST_SUITE_P(Fill, Density, ::testing::Values(0.05, 0.3, 0.5, 0.6, 0.8, 0.85));

TEST(Fill, MixesShapesBesideOtherGrainsWithoutOverlap) {
    const std::string text = box_with(
        fill_of(600, 1.2,
                "shapes = { disk = 0.5, stick = 0.3, star = 0.2 }\nsize = { distribution = \"uniform\", min = 0.5, "
                "max = 1.5 }"));
    const std::string row =
        "[[rows]]\nshape = \"star\"\nmaterial = \"stone\"\ncount = 9\nstart = [0.1, 0.5]\nstep = [0.1, 0.02]\n";
    const Scene scene = load_text(text + row).scene;
    EXPECT_EQ(scene.grains.size(), 609);
    expect_clear(scene);
}

TEST(Fill, IsDecidedBySeedAlone) {
    const std::string fill = fill_of(200, 0.5, "shapes = [\"stick\"]\nvelocity_spread = 0.1\nspin_spread = 1.0");
    const auto hash = [&](int seed) {
        return state_hash(initial_world(load_text(box_with(fill, fmt::format("[run]\nseed = {}\n", seed))).scene));
    };
    EXPECT_EQ(hash(1), hash(1));
    EXPECT_NE(hash(1), hash(2));
}

TEST(Fill, TwoFillsDrawDifferentNumbers) {
    const std::string fill = fill_of(5, 0.5, "shapes = [\"disk\"]");
    const Scene scene = load_text(box_with(fill) + "[[fill]]\nmaterial = \"stone\"\n" + fill).scene;
    EXPECT_NE(scene.grains.position(0), scene.grains.position(5));
    EXPECT_EQ(scene.grains.size(), 10);
}

TEST(Fill, ShapesComeInTheirWeights) {
    constexpr int k_count = 2000;
    const Scene scene = load_text(box_with(fill_of(k_count, 3.0, "shapes = { disk = 3, stick = 1, star = 0 }"))).scene;
    int sticks = 0, stars = 0;
    for (GrainIndex k = 0; k < k_count; ++k) {
        sticks += name(scene.shape_of(k)) == "stick" ? 1 : 0;
        stars += name(scene.shape_of(k)) == "star" ? 1 : 0;
    }
    // Binomial with p = 1/4; five standard deviations.
    EXPECT_NEAR(sticks, 0.25 * k_count, 5.0 * std::sqrt(k_count * 0.25 * 0.75));
    EXPECT_EQ(stars, 0);
}

struct SizeCase {
    const char* name;
    const char* size;
    double mean, deviation, low, high;
};

class Sizes : public ::testing::TestWithParam<SizeCase> {};

TEST_P(Sizes, FollowTheirDistribution) {
    constexpr int k_count = 2000;
    const SizeCase& c = GetParam();
    const Scene scene =
        load_text(box_with(fill_of(k_count, 2.5, fmt::format("shapes = [\"disk\"]\nsize = {}", c.size)))).scene;
    const std::vector<double> factors = size_factors(scene);
    const double error = c.deviation / std::sqrt(k_count);
    EXPECT_NEAR(mean(factors), c.mean, 4.0 * error + 1e-12);
    EXPECT_NEAR(deviation(factors), c.deviation, 0.1 * c.deviation + 1e-12);
    EXPECT_GE(*std::min_element(factors.begin(), factors.end()), c.low * (1.0 - 1e-12));
    EXPECT_LE(*std::max_element(factors.begin(), factors.end()), c.high * (1.0 + 1e-12));
}

// Means and deviations are those of the distributions cut off at three standard deviations (below 1.5 % away).
const SizeCase k_sizes[] = {
    {"plain", "0.7", 0.7, 0.0, 0.7, 0.7},
    {"uniform", "{ distribution = \"uniform\", min = 0.6, max = 1.2 }", 0.9, 0.6 / std::sqrt(12.0), 0.6, 1.2},
    {"normal", "{ distribution = \"normal\", mean = 0.9, stddev = 0.1 }", 0.9, 0.0987, 0.6, 1.2},
    {"lognormal", "{ distribution = \"lognormal\", stddev = 0.2 }", 0.998, 0.194, 0.54, 1.78},
    {"cut", "{ distribution = \"normal\", stddev = 0.1, min = 1.0, max = 1.000001 }", 1.0000005, 2.9e-7, 1.0, 1.000001},
};

std::string size_name(const ::testing::TestParamInfo<SizeCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Fill, Sizes, ::testing::ValuesIn(k_sizes), size_name);

TEST(Fill, VelocitiesSpreadAboutTheirMean) {
    constexpr int k_count = 2000;
    const Scene scene =
        load_text(box_with(fill_of(k_count, 2.5,
                                   "shapes = [\"disk\"]\nvelocity = [0.5, -1.0]\nvelocity_spread = 0.2\n"
                                   "spin_spread = 3.0")))
            .scene;
    const double error = 4.0 / std::sqrt(k_count);
    EXPECT_NEAR(mean(scene.grains.vx), 0.5, 0.2 * error);
    EXPECT_NEAR(mean(scene.grains.vy), -1.0, 0.2 * error);
    EXPECT_NEAR(mean(scene.grains.spin), 0.0, 3.0 * error);
    EXPECT_NEAR(deviation(scene.grains.vx), 0.2, 0.02);
    EXPECT_NEAR(deviation(scene.grains.vy), 0.2, 0.02);
    EXPECT_NEAR(deviation(scene.grains.spin), 3.0, 0.3);
}

TEST(Fill, StaysInFrontOfWalls) {
    // A funnel whose corners lie in the region, and a closed drum.
    const std::string funnel =
        replaced(box_with(fill_of(150, 1.0, "shapes = [\"disk\"]")), "[[0.0, 3.0], [0.0, 0.0], [1.0, 0.0], [1.0, 3.0]]",
                 "[[0.0, 1.0], [0.45, 0.0], [0.55, 0.0], [1.0, 1.0]]");
    const Scene hopper = load_text(funnel).scene;
    for (GrainIndex k = 0; k < hopper.grains.size(); ++k) {
        const Vec2 p = hopper.grains.position(k);
        EXPECT_GT(p.x(), 0.45 * (1.0 - p.y())) << "grain " << k << " is behind the left slope";
        EXPECT_LT(p.x(), 1.0 - 0.45 * (1.0 - p.y())) << "grain " << k << " is behind the right slope";
    }
    const std::string drum =
        replaced(box_with(fill_of(150, 1.0, "shapes = [\"disk\"]")), "[[0.0, 3.0], [0.0, 0.0], [1.0, 0.0], [1.0, 3.0]]",
                 "[[1.0, 0.5], [0.5, 1.0], [0.0, 0.5], [0.5, 0.0], [1.0, 0.5]]");
    const Scene diamond = load_text(drum).scene;
    for (GrainIndex k = 0; k < diamond.grains.size(); ++k) {
        const Vec2 p = diamond.grains.position(k);
        EXPECT_LT(std::abs(p.x() - 0.5) + std::abs(p.y() - 0.5), 0.5) << "grain " << k << " is outside the drum";
    }
}

/// A closed drum of n segments about (0.5, 0.5).
std::string drum_of(int n) {
    std::string points;
    for (int k = 0; k <= n; ++k) {
        const double angle = 2.0 * k_pi * (k % n) / n;
        points += fmt::format("{}[{:.17g}, {:.17g}]", k > 0 ? ", " : "", 0.5 + 0.5 * std::cos(angle),
                              0.5 + 0.5 * std::sin(angle));
    }
    return replaced(box_with(fill_of(150, 1.0, "shapes = [\"disk\"]")),
                    "[[0.0, 3.0], [0.0, 0.0], [1.0, 0.0], [1.0, 3.0]]", "[" + points + "]");
}

// Corners, of which there are many here, face halfway between the two pieces that meet there.
TEST(Fill, StaysInsideOfDrumsOfManySegments) {
    for (const int n : {3, 17, 200, 2000}) {
        const Scene scene = load_text(drum_of(n)).scene;
        ASSERT_EQ(scene.grains.size(), 150);
        const double inscribed = 0.5 * std::cos(k_pi / n);
        for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
            const Vec2 p = scene.grains.position(k) - Vec2(0.5, 0.5);
            for (int s = 0; s < n; ++s) {
                const double angle = 2.0 * k_pi * (s + 0.5) / n;
                const double depth = inscribed - p.dot(Vec2(std::cos(angle), std::sin(angle)));
                ASSERT_GT(depth, k_radius * (1.0 - 1e-6)) << "grain " << k << " in a drum of " << n;
            }
        }
    }
}

TEST(Fill, RefusesWhatCannotFit) {
    EXPECT_THAT(complaint(box_with(fill_of(4000, 1.0, "shapes = [\"disk\"]"))),
                AllOf(HasSubstr("case.toml:23:9: fill[0].count: the 4000 grains cover 1.257 m^2"),
                      HasSubstr("only 1 m^2 left"), HasSubstr("lower the count or enlarge the region")));
    EXPECT_THAT(complaint(box_with(fill_of(3000, 1.0, "shapes = [\"disk\"]"))),
                AllOf(HasSubstr("of 3000 grains found a place"), HasSubstr("lower the count")));
    EXPECT_THAT(complaint(box_with(fill_of(1, 0.03, "shapes = [\"stick\"]"))),
                AllOf(HasSubstr("fill[0].region"), HasSubstr("too narrow for a grain 0.0398")));
    EXPECT_THAT(complaint(box_with(fill_of(1, -1.0, "shapes = [\"disk\"]"))), HasSubstr("upper right corner"));
    EXPECT_THAT(complaint(box_with(fill_of(1, 1.0, "shapes = { disc = 1 }"))),
                AllOf(HasSubstr("fill[0].shapes.disc"), HasSubstr("did you mean \"disk\"?")));
    EXPECT_THAT(complaint(box_with(fill_of(1, 1.0, "shapes = { disk = 0 }"))), HasSubstr("no shape has a weight"));
    EXPECT_THAT(complaint(box_with(fill_of(1, 1.0, "shapes = [\"disk\"]\nsize = { distribution = \"norml\" }"))),
                HasSubstr("did you mean \"normal\"?"));
    EXPECT_THAT(complaint(box_with(fill_of(
                    1, 1.0, "shapes = [\"disk\"]\nsize = { distribution = \"normal\", stddev = 0.1, min = 1.1 }"))),
                HasSubstr("must rise in this order"));
}

TEST(Fill, PlacesEightThousandGrainsInASecond) {
    for (const double height : {7.0, 3.0}) {  // loose, at random; dense, on a lattice
        const std::string text = box_with(fill_of(8000, height, "shapes = [\"disk\"]"));
        const auto start = std::chrono::steady_clock::now();
        const Scene scene = load_text(text).scene;
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        EXPECT_EQ(scene.grains.size(), 8000);
        EXPECT_LT(seconds, 1.0) << "height " << height;
    }
}

}  // namespace
}  // namespace polargrain::testing
