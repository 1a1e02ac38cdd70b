#include <gtest/gtest.h>

#include <vector>

#include "src/engines/contact/gap_opening.h"

namespace polargrain {
namespace {

/// Disks of these masses in a row along x, gaps between neighbours; each gap has its aim.
struct DiskRow {
    std::vector<SolverBody> bodies;
    std::vector<GapOpening> gaps;
    std::vector<Shift> shifts;

    explicit DiskRow(const std::vector<double>& masses) : shifts(masses.size()) {
        for (const double m : masses) bodies.push_back({Vec2::Zero(), 0.0, 1.0 / m, 1e4, false});
    }

    /// The gap between grain k and the one before it.
    void add(GrainIndex k, double gap, double aim) {
        const Vec2 normal = Vec2::UnitX();
        const SolverBody& i = bodies[Grains::at(k)];
        const SolverBody& j = bodies[Grains::at(k - 1)];
        const double mass = 1.0 / (i.inverse_mass + j.inverse_mass);
        gaps.push_back(
            {normal, gap, aim, mass, 0.0, OpeningSide::of(k, i, normal, 0.0), OpeningSide::of(k - 1, j, normal, 0.0)});
    }

    /// The gap between grain 0 and a wall on its left.
    void add_wall(double gap, double aim) {
        const Vec2 normal = Vec2::UnitX();
        const OpeningSide i = OpeningSide::of(0, bodies[0], normal, 0.0);
        gaps.push_back({normal, gap, aim, 1.0 / bodies[0].inverse_mass, 0.0, i, OpeningSide{}});
    }

    void sweep(int times) {
        for (int n = 0; n < times; ++n) {
            for (GapOpening& gap : gaps) gap.relax(shifts);
        }
    }

    double way(GrainIndex k) const { return shifts[Grains::at(k)].way.x(); }
};

TEST(GapOpening, OpensAPairToItsAimByWaysThatGoAsTheInverseMasses) {
    DiskRow row({1.0, 3.0});
    row.add(1, 0.1, 0.5);
    EXPECT_TRUE(row.gaps[0].relax(row.shifts));
    EXPECT_NEAR(row.gaps[0].shifted(row.shifts), 0.5, 1e-15);
    EXPECT_NEAR(row.way(0), -0.3, 1e-15);
    EXPECT_NEAR(row.way(1), 0.1, 1e-15);
    EXPECT_EQ(row.shifts[0].way.y(), 0.0);
}

TEST(GapOpening, OpensTheGapToAWallByTheGrainAlone) {
    DiskRow row({2.0});
    row.add_wall(-0.2, 0.1);
    row.sweep(1);
    EXPECT_NEAR(row.way(0), 0.3, 1e-15);
    EXPECT_NEAR(row.gaps[0].shifted(row.shifts), 0.1, 1e-15);
}

TEST(GapOpening, TurnsAGrainThatIsPushedBesideItsCentre) {
    // A rod of mass 1 and length 1, I = 1/12, pushed upwards at its end: its end moves by 1 + 12 / 4 = 4 a unit push.
    const SolverBody rod{Vec2::Zero(), 0.0, 1.0, 12.0, false};
    std::vector<Shift> shifts(1);
    GapOpening gap{Vec2::UnitY(), 0.0, 1.0, 0.25, 0.0, OpeningSide::of(0, rod, Vec2::UnitY(), 0.5), OpeningSide{}};
    gap.relax(shifts);
    EXPECT_NEAR(gap.shifted(shifts), 1.0, 1e-15);
    EXPECT_NEAR(shifts[0].way.y(), 0.25, 1e-15);
    EXPECT_NEAR(shifts[0].turn, 1.5, 1e-15);
}

TEST(GapOpening, LetsAGapAboveItsAimCloseToItAndNeverPulls) {
    DiskRow row({1.0, 1.0});
    row.add(1, 0.5, 0.2);
    EXPECT_FALSE(row.gaps[0].relax(row.shifts));
    EXPECT_EQ(row.gaps[0].shifted(row.shifts), 0.5);
    row.shifts[1].way.x() = -0.2;
    EXPECT_FALSE(row.gaps[0].relax(row.shifts)) << "still above its aim";
    row.shifts[1].way.x() = -0.4;
    EXPECT_TRUE(row.gaps[0].relax(row.shifts));
    EXPECT_NEAR(row.gaps[0].shifted(row.shifts), 0.2, 1e-15);
}

TEST(GapOpening, GivesBackAPushThatIsNotNeededAnyMoreAndNoMoreThanThat) {
    DiskRow row({1.0, 1.0});
    row.add(1, 0.0, 0.2);
    row.sweep(1);
    row.shifts[1].way.x() += 1.0;  // something else has taken grain 1 away
    EXPECT_TRUE(row.gaps[0].relax(row.shifts));
    EXPECT_EQ(row.gaps[0].push, 0.0);
    EXPECT_NEAR(row.way(0), 0.0, 1e-15);
    EXPECT_NEAR(row.way(1), 1.0, 1e-15);
    EXPECT_FALSE(row.gaps[0].relax(row.shifts));
}

TEST(GapOpening, SweptOnTakesTheLeastMassWeightedWay) {
    // The first two overlap by 0.3, the third touches the second: for equal masses the least sum of squares has the
    // first go back by two thirds and the other two ahead by one third of it.
    DiskRow row({1.0, 1.0, 1.0});
    row.add(1, -0.3, 0.0);
    row.add(2, 0.0, 0.0);
    row.sweep(60);
    EXPECT_NEAR(row.way(0), -0.2, 1e-12);
    EXPECT_NEAR(row.way(1), 0.1, 1e-12);
    EXPECT_NEAR(row.way(2), 0.1, 1e-12);
}

TEST(GapOpening, OverlapsOnlyWhereShiftsHaveClosedIt) {
    DiskRow row({1.0, 1.0});
    row.add(1, 0.1, 0.0);
    row.add(1, -0.1, 0.0);
    const GapOpening& open = row.gaps[0];
    const GapOpening& closed = row.gaps[1];
    EXPECT_FALSE(closed.overlaps(row.shifts)) << "it did before";
    row.shifts[1].way.x() = 0.05;
    EXPECT_FALSE(closed.overlaps(row.shifts)) << "less than it did";
    row.shifts[1].way.x() = -0.05;
    EXPECT_TRUE(closed.overlaps(row.shifts)) << "more than it did";
    EXPECT_FALSE(open.overlaps(row.shifts));
    row.shifts[1].way.x() = -0.15;
    EXPECT_TRUE(open.overlaps(row.shifts));
}

TEST(GapOpening, HoldsBothGrainsWhereTheyWouldOverlapAndLetsOthersGo) {
    DiskRow row({1.0, 1.0, 1.0});
    row.add(1, 0.1, 0.0);
    row.add(2, 0.1, 0.0);
    row.shifts[0] = {{0.2, 0.3}, 0.4};
    row.shifts[1] = {{0.05, 0.0}, 0.2};
    row.shifts[2] = {{0.5, 0.0}, 0.1};
    for (const GapOpening& gap : row.gaps) gap.hold(row.shifts);
    for (const GrainIndex k : {0, 1}) {
        EXPECT_EQ(row.shifts[Grains::at(k)].way, Vec2::Zero().eval());
        EXPECT_EQ(row.shifts[Grains::at(k)].turn, 0.0);
    }
    EXPECT_EQ(row.way(2), 0.5);
    EXPECT_EQ(row.shifts[2].turn, 0.1);
}

}  // namespace
}  // namespace polargrain
