#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "src/core/random.h"
#include "tests/dem/hard_collision.h"

namespace polargrain {
namespace {

constexpr double k_disk = 0.5;

double energy_of(const RoundBody& body) {
    return 0.5 * body.mass *
           (body.motion.velocity.squaredNorm() +
            k_disk * body.radius * body.radius * body.motion.spin * body.motion.spin);
}

TEST(HardCollision, KeepsMomentumAndGivesBackWhatItsThreeNumbersSay) {
    RandomStream random(3, RandomPurpose::test);
    int slid = 0;
    int collisions = 0;
    for (int n = 0; n < 10000; ++n) {
        const HardCollisionLaw law{random.uniform(), random.uniform(), random.uniform(-1.0, 1.0)};
        RoundBody i{
            random.uniform(0.1, 3.0), random.uniform(0.1, 2.0), {{random.normal(), random.normal()}, random.normal()}};
        RoundBody j{
            random.uniform(0.1, 3.0), random.uniform(0.1, 2.0), {{random.normal(), random.normal()}, random.normal()}};
        const Vec2 normal = unit(Vec2(random.normal(), random.normal()));
        const Vec2 tangent = left_normal(normal);
        const auto closing = [&] { return (i.motion.velocity - j.motion.velocity).dot(normal); };
        const auto sliding = [&] {
            return (i.motion.velocity - j.motion.velocity).dot(tangent) -
                   (i.radius * i.motion.spin + j.radius * j.motion.spin);
        };
        const double closing_before = closing();
        const double sliding_before = sliding();
        const Vec2 impulse = hard_collision_impulse(law, i, j, normal, k_disk);
        if (closing_before >= 0.0) {
            EXPECT_EQ(impulse.squaredNorm(), 0.0);
            continue;
        }
        ++collisions;
        const double before = energy_of(i) + energy_of(j);
        i.motion = after_impulse(i, impulse, -i.radius * normal, k_disk);
        j.motion = after_impulse(j, -impulse, j.radius * normal, k_disk);
        EXPECT_NEAR(closing(), -law.restitution * closing_before, 1e-12);
        const double reached =
            std::fmin(law.tangential_restitution, -1.0 + law.friction * (1.0 + law.restitution) * (1.0 + 1.0 / k_disk) *
                                                             std::abs(closing_before / sliding_before));
        slid += reached < law.tangential_restitution ? 1 : 0;
        EXPECT_NEAR(sliding(), -reached * sliding_before, 1e-11 * (1.0 + std::abs(sliding_before)));
        EXPECT_LE(energy_of(i) + energy_of(j), before * (1.0 + 1e-13));
    }
    fmt::print("{} collisions, {} of them slid\n", collisions, slid);
    EXPECT_GT(slid, 100);
    EXPECT_GT(collisions - slid, 100);
}

TEST(HardCollision, BounceHeightsFallByTheSquareOfRestitution) {
    // From 36 to 32 inches: e = 0.9428; the second bounce reaches 28.44 inches.
    const double e = std::sqrt(32.0 / 36.0);
    EXPECT_NEAR(e, 0.9428, 1e-4);
    const RoundBody wall{std::numeric_limits<double>::infinity(), 1.0, {}};
    double height = 36.0;
    for (int bounce = 0; bounce < 2; ++bounce) {
        RoundBody ball{1.0, 1.0, {{0.0, -std::sqrt(2.0 * height)}, 0.0}};
        const Vec2 impulse = hard_collision_impulse({e, 0.0, 0.0}, ball, wall, Vec2::UnitY(), k_disk);
        ball.motion = after_impulse(ball, impulse, -Vec2::UnitY(), k_disk);
        height = 0.5 * ball.motion.velocity.y() * ball.motion.velocity.y();
    }
    EXPECT_NEAR(height, 28.44, 0.01);
}

TEST(HardCollision, CentralImpactLosesWhatTheReducedMassSays) {
    RoundBody a{2.0, 1.0, {{0.0, 3.0}, 0.0}};
    RoundBody b{0.5, 1.0, {{0.0, -1.0}, 0.0}};
    const double before = energy_of(a) + energy_of(b);
    const Vec2 impulse = hard_collision_impulse({0.6, 0.0, 0.0}, a, b, -Vec2::UnitY(), k_disk);
    a.motion = after_impulse(a, impulse, Vec2::UnitY(), k_disk);
    b.motion = after_impulse(b, -impulse, -Vec2::UnitY(), k_disk);
    EXPECT_NEAR(before - energy_of(a) - energy_of(b), 0.5 * 2.0 * 0.5 / 2.5 * (1.0 - 0.36) * 16.0, 1e-12);
}

}  // namespace
}  // namespace polargrain
