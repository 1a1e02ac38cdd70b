#include <gtest/gtest.h>

#include <cstring>

#include "src/core/random.h"
#include "src/engines/contact/contact_lanes.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

constexpr std::int32_t k_grains = 40;

std::vector<SolverBody> random_bodies(RandomStream& random) {
    std::vector<SolverBody> bodies;
    for (int k = 0; k < k_grains; ++k) {
        bodies.push_back({{random.normal(), random.normal()},
                          random.normal(),
                          random.uniform(0.5, 2.0),
                          random.uniform(0.5, 2.0),
                          false});
    }
    return bodies;
}

/// As many small disks; threads: of the loops.
Scene disks(int grains, int threads) {
    Scene scene = testing::empty_scene(0.5, 0.3);
    const ShapeIndex disk = testing::add_disk(scene, 0.5);
    for (int k = 0; k < grains; ++k) scene.add(Grain{disk, 0});
    scene.threads = threads;
    return scene;
}

const std::vector<Vec2> k_centres(k_grains, Vec2::Zero());

GapContact random_contact(BodyIndex i, BodyIndex j, RandomStream& random) {
    GapContact c;
    c.i = i;
    c.j = j;
    const double angle = random.uniform(-3.0, 3.0);
    c.normal = {std::cos(angle), std::sin(angle)};
    c.gap = random.uniform(-1e-3, 3e-3);
    c.resting = 1e-3;
    c.friction = random.uniform(0.0, 1.0);
    c.mass_n = random.uniform(0.2, 0.5);
    c.mass_t = random.uniform(0.2, 0.5);
    for (double* arm : {&c.arm_ni, &c.arm_ti, &c.arm_nj, &c.arm_tj}) *arm = random.normal();
    c.normal_impulse = std::max(0.0, random.normal());
    c.tangent_impulse = 0.3 * c.normal_impulse;
    c.low = -random.uniform(0.0, 1e-3);
    c.high = random.uniform(0.0, 1e-3);
    return c;
}

std::vector<GapContact> random_contacts(int count, RandomStream& random) {
    std::vector<GapContact> contacts;
    while (contacts.size() < static_cast<std::size_t>(count)) {
        const auto i = static_cast<BodyIndex>(random.uniform(0.0, k_grains));
        const auto j = static_cast<BodyIndex>(random.uniform(-3.0, k_grains));
        if (i != j) contacts.push_back(random_contact(i, j < 0 ? wall_body(0) : j, random));
    }
    return contacts;
}

/// The law of lasting contacts, one contact after the other, as GapSolver states it.
void sweep_one(GapContact& c, std::vector<SolverBody>& bodies, double h) {
    SolverBody wall;
    SolverBody& i = bodies[Grains::at(c.i)];
    SolverBody& j = is_wall(c.j) ? wall : bodies[Grains::at(c.j)];
    const auto give = [&](double n, double t) {
        const Vec2 p = n * c.normal + t * c.tangent();
        i.velocity += i.inverse_mass * p;
        i.spin += i.inverse_inertia * (n * c.arm_ni + t * c.arm_ti);
        j.velocity -= j.inverse_mass * p;
        j.spin -= j.inverse_inertia * (n * c.arm_nj + t * c.arm_tj);
    };
    const double open = c.gap - c.resting;
    const double target = open > 0.0 ? -open / h : 0.0;
    const double u_n = c.normal.dot(i.velocity - j.velocity) + c.arm_ni * i.spin - c.arm_nj * j.spin;
    const double normal = std::max(0.0, c.normal_impulse - c.mass_n * (u_n - target));
    give(normal - c.normal_impulse, 0.0);
    c.normal_impulse = normal;
    const double u_t = c.tangent().dot(i.velocity - j.velocity) + c.arm_ti * i.spin - c.arm_tj * j.spin;
    const double cone = c.friction * normal;
    const double tangent = std::clamp(c.tangent_impulse - c.mass_t * u_t, -cone, cone);
    give(0.0, tangent - c.tangent_impulse);
    c.tangent_impulse = tangent;
}

TEST(ContactLanes, SweepContactsOfDifferentGrainsAsOneAfterTheOther) {
    RandomStream random(1, RandomPurpose::test);
    std::vector<SolverBody> bodies = random_bodies(random);
    std::vector<SolverBody> expected = bodies;
    std::vector<GapContact> contacts;
    for (BodyIndex k = 0; k + 1 < k_grains; k += 2) contacts.push_back(random_contact(k + 1, k, random));
    ContactLanes lanes(disks(k_grains, 1));
    lanes.lay_out(contacts, k_centres, bodies);
    const double h = 1e-3;
    EXPECT_FALSE(lanes.sweep(bodies, h, {1, 1e-6, false}));
    for (GapContact& c : contacts) sweep_one(c, expected, h);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_NEAR((bodies[k].velocity - expected[k].velocity).norm(), 0.0, 1e-12) << "grain " << k;
        EXPECT_NEAR(bodies[k].spin, expected[k].spin, 1e-12);
        EXPECT_EQ(bodies[k].inverse_mass, expected[k].inverse_mass);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        EXPECT_NEAR(lanes.normal_impulse(k), contacts[k].normal_impulse, 1e-12);
        EXPECT_NEAR(lanes.tangent_impulse(k), contacts[k].tangent_impulse, 1e-12);
    }
}

TEST(ContactLanes, SolveASystemOfContactsThatShareGrains) {
    RandomStream random(2, RandomPurpose::test);
    std::vector<SolverBody> bodies = random_bodies(random);
    std::vector<GapContact> contacts = random_contacts(30, random);
    for (GapContact& c : contacts) {
        // A law that has a solution: effective masses that belong to the arms, no friction.
        const auto inverse = [&](BodyIndex k, double arm) {
            if (is_wall(k)) return 0.0;
            return bodies[Grains::at(k)].inverse_mass + bodies[Grains::at(k)].inverse_inertia * arm * arm;
        };
        c.friction = 0.0;
        c.normal_impulse = c.tangent_impulse = 0.0;
        c.mass_n = 1.0 / (inverse(c.i, c.arm_ni) + inverse(c.j, c.arm_nj));
        c.mass_t = 1.0 / (inverse(c.i, c.arm_ti) + inverse(c.j, c.arm_tj));
    }
    ContactLanes lanes(disks(k_grains, 1));
    lanes.lay_out(contacts, k_centres, bodies);
    EXPECT_TRUE(lanes.sweep(bodies, 1e-3, {20000, 1e-13, false}));
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const GapContact& c = contacts[k];
        const SolverBody& i = bodies[Grains::at(c.i)];
        const SolverBody j = is_wall(c.j) ? SolverBody{} : bodies[Grains::at(c.j)];
        const double u_n = c.normal.dot(i.velocity - j.velocity) + c.arm_ni * i.spin - c.arm_nj * j.spin;
        const double open = c.gap - c.resting;
        const double excess = u_n - (open > 0.0 ? -open / 1e-3 : 0.0);
        EXPECT_GE(excess, -1e-9) << "contact " << k << " closes too fast";
        EXPECT_NEAR(std::min(excess, lanes.normal_impulse(k)), 0.0, 1e-9) << "pushes although it opens";
    }
}

TEST(ContactLanes, TakeAnyNumberOfContactsOfOneGrain) {
    RandomStream random(3, RandomPurpose::test);
    std::vector<SolverBody> bodies = random_bodies(random);
    std::vector<SolverBody> expected = bodies;
    std::vector<GapContact> contacts;
    for (int k = 0; k < 200; ++k) contacts.push_back(random_contact(1 + k % (k_grains - 1), 0, random));
    ContactLanes lanes(disks(k_grains, 1));
    lanes.lay_out(contacts, k_centres, bodies);
    lanes.sweep(bodies, 1e-3, {1, 1e-6, false});
    // All share grain 0, so that they have been taken one after the other, in the order given.
    for (GapContact& c : contacts) sweep_one(c, expected, 1e-3);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        EXPECT_NEAR(lanes.normal_impulse(k), contacts[k].normal_impulse, 1e-9) << "contact " << k;
    }
    EXPECT_NEAR((bodies[0].velocity - expected[0].velocity).norm(), 0.0, 1e-9);
}

TEST(ContactLanes, MoveGapsAndTellWhatLeavesItsEdgeAndWhatCloses) {
    std::vector<SolverBody> bodies(2);
    bodies[0] = {{0.0, 0.0}, 0.0, 1.0, 1.0, false};
    bodies[1] = {{0.3, -0.2}, 0.0, 1.0, 1.0, false};
    GapContact c;
    c.i = 1;
    c.j = 0;
    c.normal = Vec2::UnitY();  // t = (1, 0)
    c.gap = 5e-3;
    c.resting = 1e-3;
    c.mass_n = c.mass_t = 1.0;
    c.low = -1e-3;
    c.high = 2e-3;
    c.normal_impulse = 0.5;
    ContactLanes lanes(disks(k_grains, 1));
    lanes.lay_out({c}, k_centres, bodies);
    const LaneLosses losses = lanes.move(bodies, {0.01, 0.1, 0.0});
    EXPECT_NEAR(lanes.open(0), 4e-3 - 0.2 * 0.01, 1e-15);
    EXPECT_NEAR(losses.normal, 0.5 * 0.2, 1e-15);
    std::vector<std::size_t> left;
    lanes.each_left([&](std::size_t k) { left.push_back(k); });
    EXPECT_EQ(left, std::vector<std::size_t>{0});
    EXPECT_TRUE(lanes.beyond_high(0));
    std::vector<std::int32_t> closing;
    lanes.find_closing(closing);
    EXPECT_TRUE(closing.empty()) << "2 mm are more than it closes in a sub-step";
    lanes.move(bodies, {0.008, 0.1, 0.0});
    lanes.find_closing(closing);
    EXPECT_EQ(closing, std::vector<std::int32_t>{0});
    EXPECT_NEAR((lanes.take(0, c) - Vec2(0.0, 1.0)).norm(), 0.0, 1e-15) << "twice the impulse of a sub-step";
}

/// A bed of 100 by 30 disks, each with contacts to its neighbours and a few across the whole bed.
TEST(ContactLanes, GiveTheSameBitsForAnyNumberOfThreads) {
    constexpr int n = 3000;
    const auto swept_by = [](int threads) {
        RandomStream random(5, RandomPurpose::test);
        std::vector<SolverBody> bodies;
        std::vector<Vec2> centres;
        std::vector<GapContact> contacts;
        for (int k = 0; k < n; ++k) {
            bodies.push_back({{random.normal(), random.normal()}, random.normal(), 1.0, 2.0, false});
            centres.emplace_back(k % 100, k / 100);
            if (k % 100 > 0) contacts.push_back(random_contact(k, k - 1, random));
            if (k >= 100) contacts.push_back(random_contact(k, k - 100, random));
            if (k % 500 == 499) contacts.push_back(random_contact(k, k / 2, random));
        }
        ContactLanes lanes(disks(n, threads));
        lanes.lay_out(contacts, centres, bodies);
        lanes.sweep(bodies, 1e-3, {4, 1e-9, true});
        const LaneLosses losses = lanes.move(bodies, {1e-3, 0.1, 0.0});
        std::vector<double> all{losses.normal, losses.tangent};
        for (int k = 0; k < n; ++k) {
            const SolverBody& b = bodies[static_cast<std::size_t>(k)];
            all.insert(all.end(), {b.velocity.x(), b.velocity.y(), b.spin});
        }
        for (std::size_t k = 0; k < contacts.size(); ++k) all.push_back(lanes.open(k));
        return all;
    };
    const std::vector<double> alone = swept_by(1);
    EXPECT_EQ(swept_by(2), alone);
    EXPECT_EQ(swept_by(3), alone);
}

#ifdef POLARGRAIN_SIMD
TEST(LaneKernels, GiveTheSameBitsWithAnyInstructionSet) {
    RandomStream random(4, RandomPurpose::test);
    std::vector<SolverBody> bodies = random_bodies(random);
    std::vector<LaneBlock> blocks(50);
    std::vector<TravelBlock> travels(blocks.size());
    for (LaneBlock& b : blocks) {
        for (int n = 0; n < k_lanes; ++n) {
            b.i[n] = n * 5;
            b.j[n] = n * 5 + 1 + static_cast<int>(random.uniform(0.0, 4.0));
            const double angle = random.uniform(-3.0, 3.0);
            b.normal_x.of[n] = std::cos(angle);
            b.normal_y.of[n] = std::sin(angle);
            for (Lanes* lanes : {&b.arm_ni, &b.arm_ti, &b.arm_nj, &b.arm_tj, &b.spin_ni, &b.spin_ti, &b.spin_nj,
                                 &b.spin_tj, &b.open}) {
                lanes->of[n] = random.normal();
            }
            b.mass_n.of[n] = random.uniform(0.0, 1.0);
            b.mass_t.of[n] = random.uniform(0.0, 1.0);
            b.friction.of[n] = random.uniform(0.0, 1.0);
        }
    }
    const auto computed_by = [&](const LaneKernels& kernels) {
        std::vector<SolverBody> moved = bodies;
        std::vector<LaneBlock> swept = blocks;
        std::vector<TravelBlock> travelled = travels;
        const auto count = static_cast<std::ptrdiff_t>(blocks.size());
        double* numbers = moved.front().velocity.data();
        for (int s = 0; s < 4; ++s) kernels.sweep(swept.data(), 0, count, s % 2 != 0, numbers, 10.0, 1e-3);
        const LaneLosses losses = kernels.move(swept.data(), travelled.data(), 0, count, numbers, {0.1, 0.2, 0.1});
        std::string bytes(reinterpret_cast<const char*>(swept.data()), swept.size() * sizeof(LaneBlock));
        bytes.append(reinterpret_cast<const char*>(travelled.data()), travelled.size() * sizeof(TravelBlock));
        for (const SolverBody& b : moved) {
            bytes.append(reinterpret_cast<const char*>(b.velocity.data()), 4 * sizeof(double));
        }
        bytes.append(reinterpret_cast<const char*>(&losses), sizeof(losses));
        return bytes;
    };
    const std::string baseline = computed_by(lanes_baseline::k_kernels);
    if (__builtin_cpu_supports("avx2")) {
        EXPECT_TRUE(computed_by(lanes_avx2::k_kernels) == baseline);
    }
    if (__builtin_cpu_supports("avx512f")) {
        EXPECT_TRUE(computed_by(lanes_avx512::k_kernels) == baseline);
    }
}
#endif

}  // namespace
}  // namespace polargrain
