#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/random.h"
#include "src/engines/dem/contact_geometry.h"
#include "src/engines/dem/normal_law.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

constexpr double k_stiffness = 1e6;

/// Place of a body: x, y, angle.
struct Place {
    double x = 0.0, y = 0.0, angle = 0.0;
    Pose pose() const { return Pose::at({x, y}, angle); }
    double& operator[](int d) { return d == 0 ? x : (d == 1 ? y : angle); }
};

/// Force on a body and torque about its centre of mass.
struct Wrench {
    double value[3] = {0.0, 0.0, 0.0};
    double operator[](int d) const { return value[d]; }
    double& operator[](int d) { return value[d]; }
};

struct Reaction {
    double energy = 0.0;
    Wrench on_a, on_b;
    std::size_t touches = 0;
};

/// Adds what the touches of bodies at a and b do; those by depth have linear springs.
Reaction react(const std::vector<Touch>& touches, const Vec2& a, const Vec2& b) {
    Reaction sum;
    sum.touches = touches.size();
    for (const Touch& t : touches) {
        const Elastic by_depth = linear_spring(t.depth, k_stiffness);
        const Vec2 force = (t.by_depth ? by_depth.force : t.force) * t.normal;
        sum.energy += t.by_depth ? by_depth.energy : t.energy;
        for (int d = 0; d < 2; ++d) {
            sum.on_b[d] += force[d];
            sum.on_a[d] -= force[d];
        }
        sum.on_b[2] += cross(t.point - b, force);
        sum.on_a[2] -= cross(t.point - a, force);
    }
    return sum;
}

/// Largest difference between the forces and minus the gradient of the energy by finite differences of fourth order,
/// over the largest force; torques over force x length.
template <typename React>
double gradient_error(React react_at, Place a, Place b, double length) {
    const Reaction here = react_at(a, b);
    double worst = 0.0;
    double scale = 0.0;
    for (int d = 0; d < 2; ++d) scale = std::fmax(scale, std::abs(here.on_b[d]));
    for (int body = 0; body < 2; ++body) {
        for (int d = 0; d < 3; ++d) {
            const double h = (d == 2 ? 1.0 : length) * 1e-5;
            const auto moved = [&](double by) {
                Place p = a;
                Place q = b;
                (body == 0 ? p : q)[d] += by;
                return react_at(p, q).energy;
            };
            const double slope = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
            const double force = (body == 0 ? here.on_a : here.on_b)[d];
            worst = std::fmax(worst, std::abs(force + slope) / (d == 2 ? scale * length : scale));
        }
    }
    return worst;
}

DemSettings settings_with(PolygonContact polygons, double exponent) {
    DemSettings settings;
    settings.polygons = polygons;
    settings.area_exponent = exponent;
    return settings;
}

/// Grains of radius about 10 mm, convex and not.
std::vector<std::shared_ptr<const Shape>> grains() {
    Scene scene = testing::empty_scene(1.0, 0.0);
    for (std::uint64_t draw = 1; draw <= 4; ++draw) testing::add_rough(scene, 0.01, 0.25, draw);
    testing::add_star(scene, 0.011, 0.006, 5);
    testing::add_star(scene, 0.011, 0.008, 4);
    testing::add_rectangle(scene, 0.03, 0.012);
    testing::add_stick(scene, 0.03, 0.01);
    return scene.shapes;
}

class PairEnergy : public ::testing::TestWithParam<std::tuple<PolygonContact, double>> {};

TEST_P(PairEnergy, IsWhatTheForcesAreTheGradientOf) {
    const auto [kind, exponent] = GetParam();
    TouchFinder geometry(settings_with(kind, exponent));
    const auto shapes = grains();
    RandomStream random(11, RandomPurpose::test);
    double worst = 0.0;
    double worst_balance = 0.0;
    int pairs = 0;
    int manifold = 0;
    int kinks = 0;
    while (pairs < 60) {
        const auto& s = std::get<PolarPolygon>(*shapes[random.bits() % shapes.size()]);
        const auto& t = std::get<PolarPolygon>(*shapes[random.bits() % shapes.size()]);
        const Shape shape_a = s;
        const Shape shape_b = t;
        const auto react_at = [&](const Place& a, const Place& b) {
            std::vector<Touch> touches;
            geometry.find(shape_a, a.pose(), shape_b, b.pose(), k_stiffness, touches);
            return react(touches, {a.x, a.y}, {b.x, b.y});
        };
        const Place a{0.3, -0.2, random.uniform(-3.0, 3.0)};
        const double turn = random.uniform(-3.0, 3.0);
        const double away = random.uniform(0.7, 1.0) * (s.inner_radius() + t.inner_radius()) +
                            random.uniform(0.0, 0.3) * (s.outer_radius() - s.inner_radius());
        const Place b{a.x + away * std::cos(turn), a.y + away * std::sin(turn), random.uniform(-3.0, 3.0)};
        const Reaction here = react_at(a, b);
        if (here.touches == 0) continue;
        ++pairs;
        manifold += here.touches > 1 ? 1 : 0;
        const double error = gradient_error(react_at, a, b, 0.01);
        // A finite difference across a corner that passes an edge sees a kink of the energy, not its slope.
        if (error > 1e-6) {
            ++kinks;
            continue;
        }
        worst = std::fmax(worst, error);
        const double torque = here.on_a[2] + here.on_b[2] + (b.x - a.x) * here.on_b[1] - (b.y - a.y) * here.on_b[0];
        worst_balance = std::fmax(worst_balance, std::abs(torque) / (0.01 * std::hypot(here.on_b[0], here.on_b[1])));
    }
    fmt::print("{} pairs ({} with several regions): forces against -grad W {:.2g}, torque balance {:.2g}, {} kinks\n",
               pairs, manifold, worst, worst_balance, kinks);
    EXPECT_LT(worst, 1e-8);
    EXPECT_LT(worst_balance, 1e-10);
    EXPECT_LE(kinks, 2);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PairEnergy,
                         ::testing::Values(std::tuple{PolygonContact::area, 2.0}, std::tuple{PolygonContact::area, 1.5},
                                           std::tuple{PolygonContact::area, 1.0},
                                           std::tuple{PolygonContact::potential, 2.0}));

TEST(DiskOnPolygon, PushesByTheGradientOfItsSprings) {
    TouchFinder geometry(settings_with(PolygonContact::area, 2.0));
    const auto shapes = grains();
    const Shape disk = Disk("disk", 0.008);
    RandomStream random(5, RandomPurpose::test);
    int touching = 0;
    double worst = 0.0;
    while (touching < 60) {
        const auto& polygon = std::get<PolarPolygon>(*shapes[random.bits() % shapes.size()]);
        const Shape shape = polygon;
        const bool disk_first = random.uniform() < 0.5;
        const auto react_at = [&](const Place& a, const Place& b) {
            std::vector<Touch> touches;
            geometry.find(disk_first ? disk : shape, a.pose(), disk_first ? shape : disk, b.pose(), k_stiffness,
                          touches);
            return react(touches, {a.x, a.y}, {b.x, b.y});
        };
        const double turn = random.uniform(-3.0, 3.0);
        const double away = random.uniform(1.0, 1.2) * (polygon.inner_radius() + 0.008);
        const Place a{0.1, 0.2, random.uniform(-3.0, 3.0)};
        const Place b{a.x + away * std::cos(turn), a.y + away * std::sin(turn), random.uniform(-3.0, 3.0)};
        if (react_at(a, b).touches == 0) continue;
        ++touching;
        worst = std::fmax(worst, gradient_error(react_at, a, b, 0.01));
    }
    fmt::print("{} touches: forces against -grad W {:.2g}\n", touching, worst);
    EXPECT_LT(worst, 1e-8);
}

TEST(WallAndPolygon, PushByTheGradientOfTheAreaEnergy) {
    TouchFinder geometry(settings_with(PolygonContact::area, 2.0));
    const auto shapes = grains();
    RandomStream random(6, RandomPurpose::test);
    SoftPiece piece;
    piece.a = {-0.10, 0.02};
    piece.b = {0.08, -0.04};
    piece.length = std::sqrt((piece.b - piece.a).squaredNorm());
    piece.along = (piece.b - piece.a) / piece.length;
    int touching = 0;
    double worst = 0.0;
    while (touching < 60) {
        const auto& polygon = std::get<PolarPolygon>(*shapes[random.bits() % shapes.size()]);
        const auto react_at = [&](const Place&, const Place& b) {
            std::vector<Touch> touches;
            geometry.find(piece, polygon, b.pose(), k_stiffness, touches);
            return react(touches, Vec2::Zero(), {b.x, b.y});
        };
        // Either side of the wall: it is thin.
        const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
        const Vec2 centre = piece.a + random.uniform(0.3, 0.7) * (piece.b - piece.a) +
                            side * random.uniform(0.8, 0.98) * polygon.inner_radius() * left_normal(piece.along);
        const Place b{centre.x(), centre.y(), random.uniform(-3.0, 3.0)};
        const Reaction here = react_at({}, b);
        if (here.touches == 0) continue;
        ++touching;
        EXPECT_GT(side * left_normal(piece.along).dot(Vec2(here.on_b[0], here.on_b[1])), 0.0);
        double scale = std::hypot(here.on_b[0], here.on_b[1]);
        for (int d = 0; d < 3; ++d) {
            const double h = 1e-5 * (d == 2 ? 1.0 : 0.01);
            const auto moved = [&](double by) {
                Place q = b;
                q[d] += by;
                return react_at({}, q).energy;
            };
            const double slope = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
            worst = std::fmax(worst, std::abs(here.on_b[d] + slope) / (d == 2 ? 0.01 * scale : scale));
        }
    }
    fmt::print("{} touches: forces against -grad W {:.2g}\n", touching, worst);
    EXPECT_LT(worst, 1e-8);
}

TEST(WallAndPolygon, HaveNoJumpInTheirEnergyAboutAFreeEnd) {
    TouchFinder geometry(settings_with(PolygonContact::area, 2.0));
    const auto shapes = grains();
    RandomStream random(7, RandomPurpose::test);
    SoftPiece piece;
    piece.a = {-0.2, 0.0};
    piece.length = 0.2;
    constexpr int k_steps = 20000;
    constexpr double k_grazing = 1e-10;  // J/m; below it the area is that of round-off
    int crossed = 0;
    double worst = 0.0;
    while (crossed < 100) {
        // Across the wall's line, at most so far from the end as the grain reaches, and turning.
        const auto& polygon = std::get<PolarPolygon>(*shapes[random.bits() % shapes.size()]);
        const double reach = polygon.outer_radius();
        const Vec2 middle(random.uniform(-0.2, 0.95) * reach, 0.0);
        const Vec2 way(random.uniform(-0.3, 0.3) * reach, -2.0 * reach);
        const double angle = random.uniform(-3.0, 3.0);
        const double turn = random.uniform(-2.0, 2.0);
        double energy = 0.0;
        double work = 0.0;  // of the force in a step, where it does not change
        double most = 0.0;
        double jump = 0.0;
        for (int k = 0; k <= k_steps; ++k) {
            const double s = static_cast<double>(k) / k_steps - 0.5;
            const Vec2 centre = middle + s * way;
            std::vector<Touch> touches;
            geometry.find(piece, polygon, Pose::at(centre, angle + s * turn), k_stiffness, touches);
            const Reaction now = react(touches, Vec2::Zero(), centre);
            const double work_now =
                std::abs(now.on_b[0] * way.x() + now.on_b[1] * way.y() + now.on_b[2] * turn) / k_steps;
            if (k > 0) jump = std::max(jump, std::abs(now.energy - energy) - std::max(work, work_now));
            energy = now.energy;
            work = work_now;
            most = std::max(most, energy);
        }
        if (most < k_grazing) continue;
        ++crossed;
        worst = std::max(worst, jump / most);
    }
    fmt::print("{} ways across: largest jump over the largest energy {:.2g}\n", crossed, worst);
    EXPECT_LT(worst, 1e-3);
}

TEST(OverlapArea, OfABoxAndAGrainIsThatOfTheirRegionsAndOfTheOneWithinTheOther) {
    const auto shapes = grains();
    RandomStream random(8, RandomPurpose::test);
    OverlapArea overlap;
    const auto box_about = [](const Vec2& centre, double half) {
        return std::array{Vec2(centre + Vec2(-half, -half)), Vec2(centre + Vec2(half, -half)),
                          Vec2(centre + Vec2(half, half)), Vec2(centre + Vec2(-half, half))};
    };
    double total = 0.0;
    for (int n = 0; n < 300; ++n) {
        const auto& polygon = std::get<PolarPolygon>(*shapes[random.bits() % shapes.size()]);
        const double r = polygon.outer_radius();
        const auto corner = box_about({random.uniform(0.3, 1.3) * r, random.uniform(0.3, 1.3) * r}, 0.7 * r);
        double of_regions = 0.0;
        for (const OverlapRegion& region : overlap.find(corner, polygon)) of_regions += region.area;
        EXPECT_NEAR(overlap.area(corner, polygon), of_regions, 1e-8 * r * r);
        total += of_regions / (r * r);
        const double inside = 0.1 * polygon.inner_radius();
        EXPECT_NEAR(overlap.area(box_about({0.0, 0.0}, inside), polygon), 4.0 * inside * inside, 1e-12 * r * r);
        EXPECT_NEAR(overlap.area(box_about({0.0, 0.0}, 2.0 * r), polygon), polygon.area(), 1e-12 * r * r);
        EXPECT_EQ(overlap.area(box_about({3.0 * r, 0.0}, r), polygon), 0.0);
    }
    EXPECT_GT(total, 30.0);
}

TEST(OverlapArea, OfTwoSquaresIsTheirCommonRectangle) {
    Scene scene = testing::empty_scene(1.0, 0.0);
    testing::add_rectangle(scene, 2.0, 2.0);
    const auto& square = std::get<PolarPolygon>(*scene.shapes[0]);
    OverlapArea overlap;
    const auto regions = overlap.find(square, square, Pose::at({0.3, 1.9}, 0.0));
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_NEAR(regions[0].area, 1.7 * 0.1, 1e-9);
    // The two crossing points are the corners of the rectangle where one outline enters the other.
    const double diagonal = std::hypot(1.7, 0.1);
    EXPECT_NEAR(regions[0].width, diagonal, 1e-9);
    EXPECT_NEAR(regions[0].depth, 2.0 * 1.7 * 0.1 / diagonal, 1e-9);
}

TEST(OverlapArea, OfTwoStarsInTwoPlacesIsTwoRegions) {
    // A bar across two tips of a star.
    Scene scene = testing::empty_scene(1.0, 0.0);
    testing::add_star(scene, 1.0, 0.4, 4);
    testing::add_rectangle(scene, 4.0, 0.4);
    const auto& star = std::get<PolarPolygon>(*scene.shapes[0]);
    const auto& bar = std::get<PolarPolygon>(*scene.shapes[1]);
    double tip = -10.0;
    for (int k = 0; k < star.size(); ++k) tip = std::max(tip, star.vertex(k).y());
    OverlapArea overlap;
    double total = 0.0;
    const Pose turned = Pose::at({0.0, tip * std::cos(0.7853981633974483) + 0.19}, 0.0);
    const Pose star_pose = Pose::at(Vec2::Zero(), 0.7853981633974483);
    const auto regions = overlap.find(star, bar, turned.relative_to(star_pose));
    EXPECT_EQ(regions.size(), 2U);
    for (const OverlapRegion& region : regions) total += region.area;
    EXPECT_GT(total, 0.0);
}

TEST(OverlapArea, OfAlignedBoxesThatOnlyTouchIsNothing) {
    Scene scene = testing::empty_scene(1.0, 0.0);
    testing::add_rectangle(scene, 2.0, 1.0);
    testing::add_rectangle(scene, 1.0, 1.0);
    const auto& wide = std::get<PolarPolygon>(*scene.shapes[0]);
    const auto& narrow = std::get<PolarPolygon>(*scene.shapes[1]);
    OverlapArea overlap;
    for (const PolarPolygon* upper : {&wide, &narrow}) {
        for (const double x : {0.0, 0.25, 0.5}) {
            for (const OverlapRegion& region : overlap.find(wide, *upper, Pose::at({x, 1.0}, 0.0))) {
                EXPECT_LT(region.area, 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace polargrain
