#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "src/core/random.h"
#include "src/detect/gap_reduction.h"

namespace polargrain {
namespace {

using ::testing::ElementsAre;

/// A point of a face whose normal is turned by `tilt` from upright, at a station along it; `vertex` is its name.
GapPoint point_at(double station, double gap, int vertex, double tilt = 0.0) {
    GapPoint p;
    p.normal = {std::sin(tilt), std::cos(tilt)};
    p.point = station * right_normal(p.normal);
    p.gap = gap;
    p.vertex = vertex;
    return p;
}

/// Points over an upright normal, named by their place in the list.
std::vector<GapPoint> upright(const std::vector<std::pair<double, double>>& stations_and_gaps) {
    std::vector<GapPoint> points;
    for (const auto& [station, gap] : stations_and_gaps) {
        points.push_back(point_at(station, gap, static_cast<int>(points.size())));
    }
    return points;
}

std::vector<int> names(const std::vector<GapPoint>& points) {
    std::vector<int> found;
    for (const GapPoint& p : points) found.push_back(p.vertex);
    return found;
}

std::vector<int> names_left(std::vector<GapPoint> points, std::size_t first = 0) {
    reduce_gap_points(points, first);
    return names(points);
}

/// The least gap after the bodies have come nearer by `nearer` and turned by `turn`.
double least_after(const std::vector<GapPoint>& points, double nearer, double turn) {
    double least = 1e300;
    for (const GapPoint& p : points) {
        least = std::min(least, p.gap - nearer + turn * p.point.dot(right_normal(p.normal)));
    }
    return least;
}

void shuffle(std::vector<GapPoint>& points, RandomStream& random) {
    for (std::size_t k = points.size(); k > 1; --k) {
        std::swap(points[k - 1], points[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    }
}

TEST(GapReduction, LeavesTwoPointsAlone) {
    EXPECT_THAT(names_left(upright({})), ElementsAre());
    EXPECT_THAT(names_left(upright({{0.0, 1.0}})), ElementsAre(0));
    EXPECT_THAT(names_left(upright({{0.0, 1.0}, {0.0, 2.0}})), ElementsAre(0, 1));
}

TEST(GapReduction, OfAFaceThatLiesFlatOrTiltedKeepsTheEnds) {
    for (const double slope : {0.0, 0.25, -0.25}) {
        std::vector<GapPoint> points;
        for (int k = 0; k < 6; ++k) points.push_back(point_at(0.5 * k, 5.0 + slope * 0.5 * k, k));
        EXPECT_THAT(names_left(points), ElementsAre(0, 5)) << "slope " << slope;
    }
}

TEST(GapReduction, DropsWhatIsBehindTheLineOfItsNeighbours) {
    EXPECT_THAT(names_left(upright({{0.0, 1.0}, {1.0, 2.1}, {2.0, 3.0}})), ElementsAre(0, 2));
    EXPECT_THAT(names_left(upright({{0.0, 1.0}, {1.0, 1.9}, {2.0, 3.0}})), ElementsAre(0, 1, 2));
}

TEST(GapReduction, OfTwoPointsAtOneStationKeepsTheDeeper) {
    EXPECT_THAT(names_left(upright({{0.0, 1.0}, {1.0, 1.2}, {1.0, 1.1}})), ElementsAre(0, 2));
}

TEST(GapReduction, OfARoundedGrainKeepsTheDeepestItsNeighboursAndTheFarthest) {
    const auto rounded = [](int deepest) {
        std::vector<GapPoint> points;
        for (int k = 0; k < 9; ++k) points.push_back(point_at(k, 1.0 + (k - deepest) * (k - deepest), k));
        return points;
    };
    EXPECT_THAT(names_left(rounded(3)), ElementsAre(2, 3, 4, 8));
    EXPECT_THAT(names_left(rounded(6)), ElementsAre(0, 5, 6, 7));
    EXPECT_THAT(names_left(rounded(0)), ElementsAre(0, 1, 8));
    EXPECT_THAT(names_left(rounded(7)), ElementsAre(0, 6, 7, 8));
}

TEST(GapReduction, NeverDropsWhatOverlaps) {
    std::vector<GapPoint> points = upright({{0.0, -1.0}, {1.0, -0.1}, {2.0, 0.5}, {3.0, -0.2}, {4.0, -2.0}});
    EXPECT_THAT(names_left(points), ElementsAre(0, 1, 3, 4));
    EXPECT_THAT(names_left(upright({{0.0, -1.0}, {0.0, -0.5}, {0.0, 0.5}})), ElementsAre(0, 1));
}

TEST(GapReduction, TakesFacesWithOtherNormalsApart) {
    // A corner of a box: three points over the floor, three beside the wall. Each face keeps its own two ends.
    std::vector<GapPoint> points;
    for (int k = 0; k < 3; ++k) points.push_back(point_at(k, 1.0, k));
    for (int k = 0; k < 3; ++k) points.push_back(point_at(k, 2.0, 10 + k, 0.5 * std::acos(-1.0)));
    EXPECT_THAT(names_left(points), ElementsAre(0, 2, 10, 12));
}

TEST(GapReduction, CallsNormalsSimilarWhoseCosineIsAbove0point7) {
    // The point between lies behind the line of its neighbours: it goes where it belongs to their face.
    for (const double cosine : {0.69, 0.71}) {
        std::vector<GapPoint> points = upright({{-1.0, 1.0}, {1.0, 1.1}});
        points.push_back(point_at(0.0, 5.0, 2, std::acos(cosine)));
        EXPECT_EQ(names_left(points).size(), cosine > 0.7 ? 2U : 3U) << "cosine " << cosine;
    }
}

TEST(GapReduction, JudgesNormalsByTheDeepestOfTheirGroup) {
    // Three normals 40 degrees from one another, all at one station. With the deepest in the middle they are one group;
    // with the deepest at one end, the other end is a group of its own.
    const double step = 40.0 / 180.0 * std::acos(-1.0);
    const auto three = [step](double gap_left, double gap_middle, double gap_right) {
        std::vector<GapPoint> points{point_at(0.0, gap_left, 0, -step), point_at(0.0, gap_middle, 1),
                                     point_at(0.0, gap_right, 2, step)};
        return names_left(points);
    };
    EXPECT_THAT(three(2.0, 1.0, 2.0), ElementsAre(1));
    EXPECT_THAT(three(1.0, 2.0, 3.0), ElementsAre(0, 2));
}

TEST(GapReduction, LeavesWhatStandsBeforeTheFirstAlone) {
    std::vector<GapPoint> points = upright({{0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}, {0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}});
    EXPECT_THAT(names_left(points, 3), ElementsAre(0, 1, 2, 3, 5));
}

TEST(GapReduction, KeepsTheLeastGapUnderEveryRigidMotionWhereAFaceHasUpToFourHullPoints) {
    constexpr std::uint64_t seed = 11;
    RandomStream random(seed, RandomPurpose::test);
    for (int n = 0; n < 2000; ++n) {
        std::vector<GapPoint> all;
        for (int k = 0; k < 4; ++k) all.push_back(point_at(random.uniform(-1.0, 1.0), random.uniform(), k));
        // What lies above the line between two of them is never the least gap, wherever it is.
        for (int k = 0; k < 6; ++k) {
            const double part = random.uniform();
            const GapPoint &p = all[0], &q = all[1];
            const double station = part * p.point.x() + (1.0 - part) * q.point.x();
            all.push_back(point_at(station, part * p.gap + (1.0 - part) * q.gap + random.uniform(), 4 + k));
        }
        std::vector<GapPoint> kept = all;
        reduce_gap_points(kept, 0);
        ASSERT_LE(kept.size(), static_cast<std::size_t>(GapRules::k_most_per_group));
        for (double turn = -4.0; turn <= 4.0; turn += 0.25) {
            ASSERT_EQ(least_after(kept, 0.1, turn), least_after(all, 0.1, turn))
                << "seed " << seed << ", draw " << n << ", turn " << turn;
        }
    }
}

TEST(GapReduction, OfARoundedGrainKeepsTheLeastGapInSmallTurns) {
    // On gap = s^2 the least gap after a turn is at s = -turn / 2: at the deepest or next to it for turns up to the
    // distance of two points.
    std::vector<GapPoint> all;
    for (int k = -10; k <= 10; ++k) all.push_back(point_at(0.1 * k, 0.01 * k * k, k));
    std::vector<GapPoint> kept = all;
    reduce_gap_points(kept, 0);
    EXPECT_EQ(kept.size(), 4U);
    for (double turn = -0.29; turn < 0.3; turn += 0.01) {
        EXPECT_EQ(least_after(kept, 0.0, turn), least_after(all, 0.0, turn)) << "turn " << turn;
    }
}

TEST(GapReduction, DoesNotDependOnTheOrderOfThePoints) {
    constexpr std::uint64_t seed = 12;
    RandomStream random(seed, RandomPurpose::test);
    for (int n = 0; n < 300; ++n) {
        std::vector<GapPoint> points;
        const auto count = static_cast<int>(random.uniform(3.0, 30.0));
        for (int k = 0; k < count; ++k) {
            points.push_back(point_at(random.uniform(-1.0, 1.0), random.uniform(-0.05, 1.0), k,
                                      random.uniform(-std::acos(-1.0), std::acos(-1.0))));
        }
        const std::vector<int> left = names_left(points);
        EXPECT_TRUE(std::is_sorted(left.begin(), left.end())) << "those that are left keep their order";
        for (int again = 0; again < 5; ++again) {
            shuffle(points, random);
            const std::vector<int> other = names_left(points);
            ASSERT_EQ(std::set<int>(other.begin(), other.end()), std::set<int>(left.begin(), left.end()))
                << "seed " << seed << ", draw " << n;
        }
    }
}

}  // namespace
}  // namespace polargrain
