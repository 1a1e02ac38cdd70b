#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "src/engines/contact/contact_engine.h"
#include "src/engines/contact/stillness.h"
#include "tests/support/running.h"
#include "tests/support/scenes.h"

namespace polargrain {
namespace {

using testing::Running;

constexpr double k_dt = 1e-3;

/// The next number: a change of a single bit.
void nudge(double& value) { value = std::nextafter(value, std::numeric_limits<double>::infinity()); }

/// A block at rest on a floor, its two contacts, and what tells whether its steps change anything.
struct Resting {
    Scene scene = testing::empty_scene(0.3, 0.4);
    World world;
    std::vector<GapContact> contacts{2};
    int careful = 0;
    double opening_left = 1.0;
    StepReport report;
    Stillness stillness;

    Resting() {
        testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
        scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.3, 0.01}, 0.1, {1e-3, 0.0}, 0.5});
        world = initial_world(scene);
        for (std::size_t k = 0; k < 2; ++k) {
            GapContact& c = contacts[k];
            c.j = wall_body(0);
            c.vertex = static_cast<std::int32_t>(k);
            c.point = {0.3, 0.1};
            c.gap = 2e-5;
            c.normal_impulse = 0.02;
            c.tangent_impulse = 0.01;
            c.low = -1.0;
            c.high = 1.0;
        }
    }

    /// A step that does to the block what `work` does.
    void step(const std::function<void(Resting&)>& work) {
        stillness.remember(world, contacts, careful, opening_left);
        report.clear(scene.walls.size());
        work(*this);
        stillness.judge(scene, world, contacts, careful, opening_left, world.time, k_dt, report);
        ++world.step;
        world.time = static_cast<double>(world.step) * k_dt;
    }
    /// Steps that change nothing.
    void rest(int steps = 3) {
        for (int n = 0; n < steps; ++n) step([](const Resting&) {});
    }
    bool held() const {
        StepReport next;
        return stillness.holds(scene, world, k_dt, next);
    }
};

struct Change {
    const char* name;
    std::function<void(Resting&)> make;
};
void PrintTo(const Change& change, std::ostream* out) { *out << change.name; }
std::string name_of(const ::testing::TestParamInfo<Change>& test) { return test.param.name; }

const Change k_moves[] = {
    {"x", [](Resting& r) { nudge(r.world.grains.x[0]); }},
    {"y", [](Resting& r) { nudge(r.world.grains.y[0]); }},
    {"angle", [](Resting& r) { nudge(r.world.grains.angle[0]); }},
    {"vx", [](Resting& r) { nudge(r.world.grains.vx[0]); }},
    {"vy", [](Resting& r) { nudge(r.world.grains.vy[0]); }},
    {"spin", [](Resting& r) { nudge(r.world.grains.spin[0]); }},
    {"sign_of_a_zero", [](Resting& r) { r.world.grains.vy[0] = -0.0; }},
};

const Change k_other_changes[] = {
    {"gap", [](Resting& r) { nudge(r.contacts[1].gap); }},
    {"normal_impulse", [](Resting& r) { nudge(r.contacts[1].normal_impulse); }},
    {"tangent_impulse", [](Resting& r) { nudge(r.contacts[1].tangent_impulse); }},
    {"point", [](Resting& r) { nudge(r.contacts[1].point.y()); }},
    {"normal", [](Resting& r) { nudge(r.contacts[1].normal.x()); }},
    {"low", [](Resting& r) { nudge(r.contacts[1].low); }},
    {"high", [](Resting& r) { nudge(r.contacts[1].high); }},
    {"vertex", [](Resting& r) { ++r.contacts[1].vertex; }},
    {"edge", [](Resting& r) { ++r.contacts[1].edge; }},
    {"piece", [](Resting& r) { ++r.contacts[1].piece; }},
    {"owner", [](Resting& r) { r.contacts[1].on_i = !r.contacts[1].on_i; }},
    {"wall", [](Resting& r) { r.contacts[1].j = wall_body(1); }},
    {"grain", [](Resting& r) { ++r.contacts[1].i; }},
    {"fewer_contacts", [](Resting& r) { r.contacts.pop_back(); }},
    {"more_contacts", [](Resting& r) { r.contacts.push_back(r.contacts.back()); }},
    {"effort", [](Resting& r) { ++r.careful; }},
    {"opening", [](Resting& r) { nudge(r.opening_left); }},
    {"impact", [](Resting& r) { r.report.impacts = 1; }},
    {"rejection", [](Resting& r) { r.report.moves.rejected = 1; }},
};

class StillnessOfMoves : public ::testing::TestWithParam<Change> {};

TEST_P(StillnessOfMoves, EndsWithOneBitOfAStep) {
    Resting bed;
    bed.rest();
    ASSERT_TRUE(bed.held());
    bed.step(GetParam().make);
    EXPECT_FALSE(bed.held());
    bed.rest(1);
    EXPECT_FALSE(bed.held()) << "contacts may still have changed in that one";
    bed.rest(1);
    EXPECT_TRUE(bed.held());
}

TEST_P(StillnessOfMoves, EndsWithOneBitFromElsewhere) {
    Resting bed;
    bed.rest();
    GetParam().make(bed);
    EXPECT_FALSE(bed.held());
}

INSTANTIATE_TEST_SUITE_P(Of, StillnessOfMoves, ::testing::ValuesIn(k_moves), name_of);

class StillnessOfContacts : public ::testing::TestWithParam<Change> {};

TEST_P(StillnessOfContacts, EndsWithOneBitOfAStep) {
    Resting bed;
    bed.rest();
    ASSERT_TRUE(bed.held());
    bed.step(GetParam().make);
    EXPECT_FALSE(bed.held());
    bed.rest(2);
    EXPECT_TRUE(bed.held());
}

INSTANTIATE_TEST_SUITE_P(Of, StillnessOfContacts, ::testing::ValuesIn(k_other_changes), name_of);

TEST(Stillness, IsNotKnownBeforeAStep) { EXPECT_FALSE(Resting().held()); }

TEST(Stillness, IsForgotten) {
    Resting bed;
    bed.rest();
    bed.stillness.forget();
    EXPECT_FALSE(bed.held());
    bed.rest(1);
    EXPECT_FALSE(bed.held()) << "the contacts before that step were not looked at";
}

TEST(Stillness, IsOfOneLengthOfStep) {
    Resting bed;
    bed.rest();
    StepReport next;
    EXPECT_TRUE(bed.stillness.holds(bed.scene, bed.world, k_dt, next));
    EXPECT_FALSE(bed.stillness.holds(bed.scene, bed.world, 0.5 * k_dt, next));
}

TEST(Stillness, IsOfOneKindOfReport) {
    Resting bed;
    bed.rest();
    StepReport next;
    next.record_impacts = true;
    EXPECT_FALSE(bed.stillness.holds(bed.scene, bed.world, k_dt, next));
}

TEST(Stillness, ReportsWhatTheLastStepHasReported) {
    Resting bed;
    const auto press = [](Resting& r) {
        r.report.contacts.push_back({wall_body(0), 0, {0.3, 0.0}, Vec2::UnitY(), 2e-5, {0.01, 0.02}});
        r.report.walls[0] = {{-0.01, -0.02}, 0.003};
        r.report.moves.tried = 1;
        r.report.deepest = -2e-5;
        r.report.ledger.correction = 1e-9;
    };
    for (int n = 0; n < 3; ++n) bed.step(press);
    StepReport next;
    ASSERT_TRUE(bed.stillness.holds(bed.scene, bed.world, k_dt, next));
    ASSERT_EQ(next.contacts.size(), 1U);
    EXPECT_EQ(next.contacts[0].impulse, Vec2(0.01, 0.02));
    ASSERT_EQ(next.walls.size(), 1U);
    EXPECT_EQ(next.walls[0].linear, Vec2(-0.01, -0.02));
    EXPECT_EQ(next.walls[0].angular, 0.003);
    EXPECT_EQ(next.moves.tried, 1);
    EXPECT_EQ(next.deepest, -2e-5);
    EXPECT_EQ(next.ledger.correction, 1e-9);
}

TEST(Stillness, LeavesTheReportAloneWhereItDoesNotHold) {
    Resting bed;
    StepReport next;
    next.impacts = 7;
    EXPECT_FALSE(bed.stillness.holds(bed.scene, bed.world, k_dt, next));
    EXPECT_EQ(next.impacts, 7);
}

TEST(Stillness, IsNoneBesideAWallThatMoves) {
    const WallMotion motions[] = {SineMotion{Vec2::UnitX(), 0.01, 5.0, 0.0}, RotationMotion{Vec2::Zero(), 1.0, 0.0}};
    for (const WallMotion& motion : motions) {
        Resting bed;
        bed.scene.walls[0].motion = motion;
        bed.rest();
        EXPECT_FALSE(bed.held());
    }
}

TEST(Stillness, EndsInTimeForAWallThatBeginsToMove) {
    Resting bed;
    const double start = 10.5 * k_dt;
    bed.scene.walls[0].motion = SineMotion{Vec2::UnitX(), 0.01, 5.0, start};
    for (int n = 0; n < 20; ++n) {
        bed.rest(1);
        EXPECT_FALSE(bed.held() && bed.world.time + k_dt > start) << "step " << bed.world.step;
    }
}

TEST(Stillness, EndsWithTheStepInWhichAWallGoesAndComesBackWhenItIsGone) {
    for (const double removed : {10.0 * k_dt, 10.5 * k_dt}) {
        Resting bed;
        bed.scene.walls[0].remove_at = removed;
        int held_before = 0;
        int held_after = 0;
        for (int n = 0; n < 20; ++n) {
            bed.rest(1);
            const double time = bed.world.time;
            const bool there = bed.scene.walls[0].present(time);
            // The step before ended here: it has found contacts with what was there at its end.
            const bool goes = bed.scene.walls[0].present(time - k_dt) != bed.scene.walls[0].present(time + k_dt);
            EXPECT_FALSE(goes && bed.held()) << "step " << bed.world.step << ", removed at " << removed;
            (there ? held_before : held_after) += bed.held() ? 1 : 0;
        }
        EXPECT_GT(held_before, 5);
        EXPECT_GT(held_after, 5);
    }
}

TEST(Stillness, MindsAMovingWallOnlyWhileItIsThere) {
    Resting bed;
    testing::add_wall(bed.scene, "gate", {{0.0, 0.5}, {0.1, 0.5}}, SineMotion{Vec2::UnitX(), 0.01, 5.0, 0.0});
    bed.scene.walls[1].remove_at = 5.5 * k_dt;
    bed.rest(5);
    EXPECT_FALSE(bed.held());
    bed.rest(5);
    EXPECT_TRUE(bed.held());
}

/// Twelve rough grains that fall into a box; its floor may move or go long after they have come to rest.
Scene small_bed() {
    Scene scene = testing::pour(testing::PourShape::rough, 12, 3, 0.3, 0.5, 5);
    const Wall box = scene.walls[0];
    scene.walls.clear();
    testing::add_wall(scene, "left", {box.points[0], box.points[1]});
    testing::add_wall(scene, "floor", {box.points[1], box.points[2]});
    testing::add_wall(scene, "right", {box.points[2], box.points[3]});
    return scene;
}

void expect_same_report(const StepReport& p, const StepReport& q) {
    ASSERT_EQ(p.contacts.size(), q.contacts.size());
    for (std::size_t k = 0; k < p.contacts.size(); ++k) {
        const Contact& a = p.contacts[k];
        const Contact& b = q.contacts[k];
        ASSERT_TRUE(a.a == b.a && a.b == b.b && a.point == b.point && a.normal == b.normal && a.gap == b.gap &&
                    a.impulse == b.impulse);
    }
    for (std::size_t k = 0; k < p.walls.size(); ++k) {
        ASSERT_EQ(p.walls[k].linear, q.walls[k].linear);
        ASSERT_EQ(p.walls[k].angular, q.walls[k].angular);
    }
    const EnergyLedger& l = p.ledger;
    const EnergyLedger& m = q.ledger;
    ASSERT_TRUE(l.restitution_loss == m.restitution_loss && l.friction_loss == m.friction_loss &&
                l.wall_work == m.wall_work && l.correction == m.correction && l.created == m.created &&
                l.rises == m.rises && l.stored == m.stored);
    ASSERT_TRUE(p.moves.tried == q.moves.tried && p.moves.rejected == q.moves.rejected && p.impacts == q.impacts);
    ASSERT_EQ(p.deepest, q.deepest);
}

struct Awakening {
    const char* name;
    void (*set)(Wall& floor);
};
void PrintTo(const Awakening& awakening, std::ostream* out) { *out << awakening.name; }

class BedAtRest : public ::testing::TestWithParam<Awakening> {};

// An engine that leaves still steps out beside one that forgets before each step, and so does them all.
TEST_P(BedAtRest, GoesOnAsIfEveryStepWereDone) {
    Scene scene = small_bed();
    GetParam().set(scene.walls[1]);
    Running lazy(make_contact, scene);
    Running busy(make_contact, scene);
    std::vector<double> y_before;
    int still = 0;
    lazy.run(1.2, k_dt, [&] {
        Checkpoint checkpoint;
        busy.engine->save(checkpoint);
        busy.engine->load(checkpoint);
        busy.step(k_dt);
        ASSERT_EQ(state_hash(lazy.world), state_hash(busy.world)) << "step " << lazy.world.step;
        ASSERT_NO_FATAL_FAILURE(expect_same_report(lazy.report, busy.report)) << "step " << lazy.world.step;
        still += lazy.world.grains.y == y_before ? 1 : 0;
        y_before = lazy.world.grains.y;
    });
    EXPECT_GT(still, 100) << "steps at rest: too few to mean anything";
    EXPECT_GE(lazy.world.step, 1200);
}

INSTANTIATE_TEST_SUITE_P(
    Floor, BedAtRest,
    ::testing::Values(Awakening{"stays", [](Wall&) {}}, Awakening{"goes", [](Wall& floor) { floor.remove_at = 1.1; }},
                      Awakening{"goes_within_a_step", [](Wall& floor) { floor.remove_at = 1.1003; }},
                      Awakening{"begins_to_move",
                                [](Wall& floor) {
                                    floor.motion = SineMotion{Vec2::UnitX(), 2e-3, 5.0, 1.1};
                                }}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BedAtRest, FallsFreelyFromTheStepInWhichItsFloorGoes) {
    Scene scene = testing::empty_scene(0.3, 0.4);
    testing::add_wall(scene, "floor", {{-1.0, 0.0}, {1.0, 0.0}});
    scene.walls[0].remove_at = 0.3;
    scene.add(Grain{testing::add_rectangle(scene, 0.02, 0.02), 0, {0.0, 0.01}});
    Running sim(make_contact, scene);
    sim.run(0.3, k_dt);
    const double rest = sim.world.grains.y[0];
    EXPECT_EQ(sim.world.grains.vy[0], 0.0);
    sim.run(0.4, k_dt);
    EXPECT_NEAR(sim.world.grains.y[0] - rest, -0.5 * 9.81 * 0.01, 1e-9);
}

}  // namespace
}  // namespace polargrain
