#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "src/core/elementary.h"
#include "src/core/random.h"
#include "src/engines/contact/impact_law.h"

namespace polargrain {
namespace {

struct Case {
    std::string mode;
    ImpactBody body_1, body_2;
    Motion motion_1, motion_2, after_1, after_2;
    ContactFrame frame;
    double mu = 0.0, e = 0.0, tangential = 0.0, normal = 0.0;
    std::string id;
};

/// Impacts integrated numerically in the impulse domain, independently of any closed form.
std::vector<Case> oracle() {
    std::ifstream file(POLARGRAIN_SOURCE_DIR "/tests/engines/impact_cases.csv");
    std::vector<Case> cases;
    std::vector<std::string> header;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::vector<std::string> cells;
        std::stringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        if (header.empty()) {
            header = cells;
            continue;
        }
        std::map<std::string, std::string> at;
        for (std::size_t k = 0; k < header.size(); ++k) at[header[k]] = cells.at(k);
        const auto number = [&at](const char* key) { return std::stod(at.at(key)); };
        const auto vector = [&](const char* x, const char* y) { return Vec2(number(x), number(y)); };
        Case c;
        c.id = at["id"];
        c.mode = at["mode"];
        c.body_1 = {1.0 / number("m1"), 1.0 / number("I1")};
        c.body_2 = {1.0 / number("m2"), 1.0 / number("I2")};
        c.motion_1 = {vector("v1x", "v1y"), number("w1")};
        c.motion_2 = {vector("v2x", "v2y"), number("w2")};
        c.after_1 = {vector("v1x_out", "v1y_out"), number("w1_out")};
        c.after_2 = {vector("v2x_out", "v2y_out"), number("w2_out")};
        const Vec2 point = vector("cx", "cy");
        c.frame = contact_frame(vector("nx", "ny"), point - vector("x1", "y1"), c.body_1, point - vector("x2", "y2"),
                                c.body_2);
        c.mu = number("mu");
        c.e = number("estar");
        c.tangential = number("Pt");
        c.normal = number("Pn");
        cases.push_back(c);
    }
    return cases;
}

std::string oracle_name(SlipMode mode) {
    switch (mode) {
        case SlipMode::separating: return "separating";
        case SlipMode::sliding: return "slide";
        case SlipMode::sticks_in_compression: return "stick_compression";
        case SlipMode::reverses_in_compression: return "reverse_compression";
        case SlipMode::sticks_in_restitution: return "stick_restitution";
        case SlipMode::reverses_in_restitution: return "reverse_restitution";
        case SlipMode::direct_sticking: return "direct_stick";
        case SlipMode::direct_sliding: return "direct_slide";
        case SlipMode::on_feet:
        case SlipMode::on_face:
        case SlipMode::foot: break;  // of more than two bodies
    }
    return "";
}

TEST(ImpactLaw, AgreesWithTheImpulseDomainIntegration) {
    const std::vector<Case> cases = oracle();
    ASSERT_EQ(cases.size(), 400U);
    for (const Case& c : cases) {
        SCOPED_TRACE("case " + c.id);
        const ImpactResult result =
            solve_impact(c.frame, relative_velocity(c.frame, c.motion_1, c.motion_2), c.mu, c.e);
        EXPECT_EQ(oracle_name(result.mode), c.mode);
        EXPECT_NEAR(result.normal, c.normal, 1e-9 * std::max(1.0, c.normal));
        EXPECT_NEAR(result.tangential, c.tangential, 1e-9 * std::max(1.0, c.normal));
        Motion after_1 = c.motion_1;
        Motion after_2 = c.motion_2;
        apply_impulse(c.frame, result, c.body_1, after_1);
        apply_reaction(c.frame, result, c.body_2, after_2);
        const auto expect_motion = [](const Motion& measured, const Motion& expected) {
            EXPECT_NEAR(measured.velocity.x(), expected.velocity.x(), 1e-9);
            EXPECT_NEAR(measured.velocity.y(), expected.velocity.y(), 1e-9);
            EXPECT_NEAR(measured.spin, expected.spin, 1e-9 * std::max(1.0, std::abs(expected.spin)));
        };
        expect_motion(after_1, c.after_1);
        expect_motion(after_2, c.after_2);
    }
}

struct RandomImpact {
    ImpactBody i, j;
    Vec2 centre_i, centre_j;
    Motion motion_i, motion_j;
    ContactFrame frame;
    double mu, e;
};

RandomImpact random_impact(RandomStream& random) {
    RandomImpact r;
    const bool wall = random.uniform() < 0.2;
    r.i = {1.0 / random.uniform(0.1, 10.0), 1.0 / random.uniform(0.002, 2.0)};
    r.j = wall ? ImpactBody{} : ImpactBody{1.0 / random.uniform(0.1, 10.0), 1.0 / random.uniform(0.002, 2.0)};
    r.centre_i = {random.uniform(-1, 1), random.uniform(-1, 1)};
    r.centre_j = wall ? Vec2(0.0, 0.0) : Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    r.motion_i = {{random.normal(), random.normal()}, random.normal()};
    r.motion_j = {{random.normal(), random.normal()}, random.normal()};
    const Vec2 point{random.uniform(-1, 1), random.uniform(-1, 1)};
    const auto [sine, cosine] = sine_cosine(random.uniform(-k_pi, k_pi));
    r.frame = contact_frame({cosine, sine}, point - r.centre_i, r.i, point - r.centre_j, r.j);
    r.mu = random.uniform() < 0.1 ? 0.0 : random.uniform(0.0, 1.5);
    r.e = random.uniform() < 0.1 ? (random.uniform() < 0.5 ? 0.0 : 1.0) : random.uniform();
    return r;
}

double kinetic(const ImpactBody& body, const Motion& motion) {
    if (body.inverse_mass == 0.0) return 0.0;
    return 0.5 * motion.velocity.squaredNorm() / body.inverse_mass +
           0.5 * motion.spin * motion.spin / body.inverse_inertia;
}

TEST(ImpactLaw, KeepsMomentumConeSeparationAndEnergyInRandomImpacts) {
    constexpr std::uint64_t seed = 20;
    RandomStream random(seed, RandomPurpose::test);
    int jams = 0;
    std::map<SlipMode, int> modes;
    for (int n = 0; n < 100000; ++n) {
        SCOPED_TRACE("seed 20, impact " + std::to_string(n));
        const RandomImpact r = random_impact(random);
        const RelativeVelocity before = relative_velocity(r.frame, r.motion_i, r.motion_j);
        const ImpactResult p = solve_impact(r.frame, before, r.mu, r.e);
        ++modes[p.mode];
        if (before.closing >= 0.0) {
            ASSERT_EQ(p.normal, 0.0);
            continue;
        }
        const double s = before.sliding > 0.0 ? 1.0 : -1.0;
        if (r.frame.b2 + s * r.mu * r.frame.b3 <= 0.0) ++jams;
        Motion i = r.motion_i;
        Motion j = r.motion_j;
        apply_impulse(r.frame, p, r.i, i);
        apply_reaction(r.frame, p, r.j, j);
        const double scale = std::abs(before.closing) + std::abs(before.sliding);

        ASSERT_GT(p.normal, 0.0);
        ASSERT_LE(std::abs(p.tangential), r.mu * p.normal * (1.0 + 1e-12) + 1e-15);
        ASSERT_GE(relative_velocity(r.frame, i, j).closing, -1e-11 * scale);
        ASSERT_GE(p.restitution_loss, -1e-12);
        ASSERT_GE(p.friction_loss, -1e-9 * scale * scale);
        if (r.j.inverse_mass > 0.0) {
            const Vec2 momentum = (i.velocity - r.motion_i.velocity) / r.i.inverse_mass +
                                  (j.velocity - r.motion_j.velocity) / r.j.inverse_mass;
            ASSERT_NEAR(momentum.norm(), 0.0, 1e-11 * (1.0 + p.normal));
            const double angular = (i.spin - r.motion_i.spin) / r.i.inverse_inertia +
                                   cross(r.centre_i, Vec2((i.velocity - r.motion_i.velocity) / r.i.inverse_mass)) +
                                   (j.spin - r.motion_j.spin) / r.j.inverse_inertia +
                                   cross(r.centre_j, Vec2((j.velocity - r.motion_j.velocity) / r.j.inverse_mass));
            ASSERT_NEAR(angular, 0.0, 1e-10 * (1.0 + p.normal));
            const double lost = kinetic(r.i, r.motion_i) + kinetic(r.j, r.motion_j) - kinetic(r.i, i) - kinetic(r.j, j);
            ASSERT_NEAR(lost, p.restitution_loss + p.friction_loss, 1e-9 * (1.0 + std::abs(lost)));
        }
    }
    EXPECT_GT(jams, 100);
    for (const SlipMode mode : {SlipMode::sliding, SlipMode::sticks_in_compression, SlipMode::reverses_in_compression,
                                SlipMode::sticks_in_restitution, SlipMode::reverses_in_restitution}) {
        EXPECT_GT(modes[mode], 300) << to_string(mode);
    }
}

TEST(ImpactLaw, RestitutionIsEnergetic) {  // work in restitution = -e^2 x work in compression [S90]
    RandomStream random(21, RandomPurpose::test);
    for (int n = 0; n < 2000; ++n) {
        const RandomImpact r = random_impact(random);
        const RelativeVelocity before = relative_velocity(r.frame, r.motion_i, r.motion_j);
        if (before.closing >= 0.0) continue;
        // With e = 0 the whole normal work is the work of compression.
        const ImpactResult plastic = solve_impact(r.frame, before, r.mu, 0.0);
        const ImpactResult real = solve_impact(r.frame, before, r.mu, r.e);
        ASSERT_NEAR(real.restitution_loss, (1.0 - r.e * r.e) * plastic.restitution_loss,
                    1e-10 * (1.0 + plastic.restitution_loss));
    }
}

/// A uniform rod whose lower end strikes a fixed floor; theta is its angle to the floor.
ImpactResult rod_impact(double degrees, double e, double mu, const Vec2& velocity, Motion& after) {
    const ImpactBody rod{1.0, 12.0};
    const auto [sine, cosine] = sine_cosine(degrees * k_radians_per_degree);
    const Vec2 arm = Vec2(-0.5 * cosine, -0.5 * sine);
    const ContactFrame frame = contact_frame(Vec2::UnitY(), arm, rod, Vec2::Zero(), {});
    after = {velocity, 0.0};
    const ImpactResult result = solve_impact(frame, relative_velocity(frame, after, {}), mu, e);
    apply_impulse(frame, result, rod, after);
    return result;
}

TEST(ImpactLaw, RodOnAFloorAtSixtyDegrees) {
    Motion after;
    const ImpactResult p = rod_impact(60.0, 0.5, 0.3, {0.0, -1.0}, after);
    EXPECT_NEAR(p.normal, 1.102707, 1e-6);
    EXPECT_NEAR(std::abs(p.tangential), 0.330812, 1e-6);
    EXPECT_NEAR(std::abs(after.spin), 1.589171, 1e-6);
    EXPECT_NEAR(kinetic({1.0, 12.0}, after), 0.165220, 1e-6);
}

TEST(ImpactLaw, RodWhoseSlipReversesIsEnergeticNotPoissonNorNewton) {
    const auto normal_impulse = [](double e, double& rebound) {
        Motion after;
        const ImpactResult p = rod_impact(45.0, e, 0.5, {0.5, -1.0}, after);
        rebound = after.velocity.y() - 0.5 * std::sqrt(0.5) * after.spin;
        return p.normal;
    };
    double rebound = 0.0;
    EXPECT_NEAR(normal_impulse(0.5, rebound), 0.639775, 1e-6);
    // Poisson: restitution gives half the impulse of compression on top of it.
    EXPECT_NEAR(1.5 * normal_impulse(0.0, rebound), 0.623377, 1e-6);
    EXPECT_NEAR(rebound, 0.0, 1e-12);
    // Newton: the contact parts at half the speed at which it closed. The impulse is linear in it beyond compression.
    double none = 0.0, all = 0.0;
    const double least = normal_impulse(0.0, none), most = normal_impulse(1.0, all);
    EXPECT_NEAR(least + (most - least) * 0.5 / all, 0.701299, 1e-6);
}

TEST(ImpactLaw, MirrorImageMirrorsTheImpulse) {
    RandomStream random(22, RandomPurpose::test);
    for (int n = 0; n < 1000; ++n) {
        const RandomImpact r = random_impact(random);
        const auto mirrored = [](const Vec2& v) { return Vec2(-v.x(), v.y()); };
        const ContactFrame frame =
            contact_frame(mirrored(r.frame.normal), mirrored(r.frame.arm_i), r.i, mirrored(r.frame.arm_j), r.j);
        const Motion i{mirrored(r.motion_i.velocity), -r.motion_i.spin};
        const Motion j{mirrored(r.motion_j.velocity), -r.motion_j.spin};
        const ImpactResult p = solve_impact(r.frame, relative_velocity(r.frame, r.motion_i, r.motion_j), r.mu, r.e);
        const ImpactResult q = solve_impact(frame, relative_velocity(frame, i, j), r.mu, r.e);
        EXPECT_NEAR(p.normal, q.normal, 1e-12 * (1.0 + p.normal));
        EXPECT_NEAR(p.tangential, -q.tangential, 1e-12 * (1.0 + p.normal));
    }
}

}  // namespace
}  // namespace polargrain
