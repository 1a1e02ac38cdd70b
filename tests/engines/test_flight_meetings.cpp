#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "src/core/random.h"
#include "src/detect/contact_finder.h"
#include "src/detect/outline_meeting.h"
#include "src/engines/contact/contact_engine.h"
#include "src/engines/contact/gap_detection.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

struct OfShape {
    const char* name;
    ShapeIndex (*add)(Scene&, std::uint64_t);
};

constexpr double k_speed = 1.0;    // of approach [m/s]
constexpr double k_radius = 0.01;  // about that of the shapes [m]

/// Two turning grains of a shape that come upon one another without gravity, at an offset and at angles that the seed
/// decides.
Scene pair_of(const OfShape& shape, std::uint64_t seed, double restitution, double friction) {
    Scene scene = testing::empty_scene(restitution, friction, 0.0);
    RandomStream random(seed, RandomPurpose::test, 0);
    const ShapeIndex first = shape.add(scene, 2 * seed);
    const ShapeIndex second = shape.add(scene, 2 * seed + 1);
    scene.add(Grain{first, 0, {0.0, 0.0}, 6.0 * random.uniform(), {0.5 * k_speed, 0.1}, 15.0 * random.normal()});
    scene.add(Grain{second,
                    0,
                    {0.06, 0.9 * k_radius * random.normal()},
                    6.0 * random.uniform(),
                    {-0.5 * k_speed, 0.1},
                    15.0 * random.normal()});
    return scene;
}

Flight flight_of(const Grains& grains, GrainIndex k) {
    return {grains.position(k), grains.angle[Grains::at(k)], grains.velocity(k), grains.spin[Grains::at(k)]};
}

class TwoPolygons : public ::testing::TestWithParam<OfShape> {
protected:
    static constexpr std::uint64_t k_pairs = 40;
    static constexpr double k_duration = 0.12;  // [s]
};

// At the critical step, in which they move by a good part of their size.
TEST_P(TwoPolygons, KeepTheirAngularMomentum) {
    int struck = 0;
    for (std::uint64_t seed = 0; seed < k_pairs; ++seed) {
        SCOPED_TRACE(seed);
        Running sim(make_contact, pair_of(GetParam(), seed, 1.0, 0.0));
        const double before = testing::angular_momentum(sim.world.grains);
        sim.run(k_duration, critical_time_step(sim.scene));
        struck += sim.impacts > 0 ? 1 : 0;
        const double scale = sim.world.grains.mass[0] * k_speed * k_radius;
        EXPECT_NEAR(testing::angular_momentum(sim.world.grains), before, 1e-11 * scale);
        EXPECT_NEAR(sim.total_energy() / sim.start_energy, 1.0, 1e-13);
    }
    EXPECT_GT(struck, static_cast<int>(k_pairs) / 2);
}

TEST_P(TwoPolygons, MeetWhereTheirPathsSay) {
    int struck = 0;
    for (std::uint64_t seed = 0; seed < k_pairs; ++seed) {
        SCOPED_TRACE(seed);
        Running sim(make_contact, pair_of(GetParam(), seed, 0.5, 0.3));
        const Flight i = flight_of(sim.world.grains, 1);
        const Flight j = flight_of(sim.world.grains, 0);
        const auto meeting = first_meeting(std::get<PolarPolygon>(sim.scene.shape_of(1)), i,
                                           std::get<PolarPolygon>(sim.scene.shape_of(0)), j,
                                           GapDetection(sim.scene).resting_gap(1, 0), 0.0, k_duration);
        sim.report.record_impacts = true;
        ImpactRecord impact;
        sim.run(k_duration, critical_time_step(sim.scene), [&] {
            for (const ImpactRecord& r : sim.report.impact_records) impact = r;
        });
        ASSERT_EQ(sim.impacts > 0, meeting.has_value());
        if (sim.impacts != 1) continue;  // others meet again
        ++struck;
        // Free flight, impact, free flight, whatever the steps.
        const double after = sim.world.time - meeting->time;
        const Vec2 impulse =
            impact.impulse_normal * impact.normal + impact.impulse_tangential * right_normal(impact.normal);
        const Grains& grains = sim.world.grains;
        const Vec2 there = i.at(sim.world.time).centre + after / grains.mass[1] * impulse;
        EXPECT_NEAR((grains.position(1) - there).norm(), 0.0, 1e-10 * k_radius);
        const Vec2 arm = impact.point - i.at(meeting->time).centre;
        const double angle = i.angle + sim.world.time * i.spin + after / grains.inertia[1] * cross(arm, impulse);
        EXPECT_NEAR(grains.angle[1], angle, 1e-9);
    }
    EXPECT_GT(struck, static_cast<int>(k_pairs) / 8);
}

INSTANTIATE_TEST_SUITE_P(
    OfShapes, TwoPolygons,
    ::testing::Values(
        OfShape{"squares", [](Scene& s, std::uint64_t) { return testing::add_rectangle(s, 0.018, 0.018); }},
        OfShape{"rough", [](Scene& s, std::uint64_t draw) { return testing::add_rough(s, 0.01, 0.2, draw); }},
        OfShape{"stars", [](Scene& s, std::uint64_t) { return testing::add_star(s, 0.012, 0.006, 5); }},
        OfShape{"sticks", [](Scene& s, std::uint64_t) { return testing::add_stick(s, 0.03, 0.003); }}),
    [](const auto& with) { return std::string(with.param.name); });

// Corners that the search for contact points, at the beginning of the step, sees before a face that they only pass.
TEST(PolygonsThatPass, AreNotStruck) {
    for (const double height : {0.01801, 0.0181, 0.0185}) {
        for (const double speed : {0.3, 1.0, 3.0}) {
            Scene scene = testing::empty_scene(0.7, 0.4, 0.0);
            const ShapeIndex square = testing::add_rectangle(scene, 0.018, 0.018);
            scene.add(Grain{square, 0, {0.0, 0.0}});
            scene.add(Grain{square, 0, {0.05, height + 2e-5}, 0.0, {-speed, 0.0}});
            Running sim(make_contact, scene);
            sim.run(0.1 / speed, 0.002 / speed);
            EXPECT_EQ(sim.impacts, 0) << height << " " << speed;
            EXPECT_EQ(sim.world.grains.velocity(0), Vec2::Zero());
            EXPECT_EQ(sim.world.grains.velocity(1), Vec2(-speed, 0.0));
        }
    }
}

}  // namespace
}  // namespace polargrain
