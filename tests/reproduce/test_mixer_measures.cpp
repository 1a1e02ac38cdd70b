#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/core/random.h"
#include "src/reproduce/mixer_measures.h"
#include "src/reproduce/mixer_runs.h"
#include "src/reproduce/statistics.h"

namespace polargrain {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SideChanges, CountOnlyPassagesThatGoOn) {
    EXPECT_THAT(side_changes(std::vector{-1.0, -0.2, 0.2, 1.0, 2.0}, 0.5), ElementsAre(2));
    EXPECT_THAT(side_changes(std::vector{-1.0, 0.2, -0.2, 0.3, -1.0}, 0.5), IsEmpty())
        << "never deep on the other side";
    EXPECT_THAT(side_changes(std::vector{-1.0, 0.2, -0.2, 0.3, 1.0}, 0.5), ElementsAre(3)) << "the last passage counts";
    EXPECT_THAT(side_changes(std::vector{-1.0, 1.0, -1.0, -2.0}, 0.5), ElementsAre(1, 2)) << "there and back are two";
    EXPECT_THAT(side_changes(std::vector{0.1, 0.2, 1.0}, 0.5), IsEmpty()) << "the first side is none that changed";
}

/// Heights between 0 and 2 with a period of 3 s.
std::vector<double> swing(const std::vector<double>& time) {
    std::vector<double> height;
    for (const double t : time) height.push_back(1.0 - std::cos(2.0 * std::numbers::pi * t / 3.0));
    return height;
}

std::vector<double> times(double step, int count) {
    std::vector<double> time;
    for (int k = 0; k < count; ++k) time.push_back(k * step);
    return time;
}

TEST(RoundTrips, OfASwingTakeTheTimeAboveTheFirstLevel) {
    const std::vector<double> time = times(0.01, 1000);  // three periods and a third
    // Above 0.5 while cos < 0.5: two thirds of the period.
    const std::vector<double> trips = round_trips(time, swing(time), 0.5, 1.5);
    ASSERT_EQ(trips.size(), 3U);
    EXPECT_THAT(trips, Each(::testing::DoubleNear(2.0, 1e-4)));
    EXPECT_THAT(round_trips(time, swing(time), 0.5, 2.1), IsEmpty()) << "never reaches the second level";
}

TEST(RoundTrips, BeginAtTheLastPassageBeforeTheSecondLevel) {
    const std::vector<double> time = times(1.0, 9);
    // Up through 0.5 at 0.5 s, back, up again at 2.5 s, over 1.5, and back at 6.5 s; then up once more for good.
    const std::vector<double> height{0.0, 1.0, 0.0, 1.0, 2.0, 2.0, 1.0, 0.0, 1.0};
    EXPECT_THAT(round_trips(time, height, 0.5, 1.5), ElementsAre(4.0));
    EXPECT_THAT(round_trips(times(1.0, 3), std::vector{2.0, 1.0, 0.0}, 0.5, 1.5), IsEmpty()) << "began above";
}

TEST(Dispersion, OfACommonShiftIsNone) {
    EXPECT_EQ(displacement_variance(std::vector<Vec2>{}), 0.0);
    EXPECT_NEAR(displacement_variance(std::vector(5, Vec2(0.3, -0.2))), 0.0, 1e-16);
}

TEST(Dispersion, OfARandomWalkGrowsWithTheNumberOfItsSteps) {
    constexpr std::uint64_t k_seed = 5;
    SCOPED_TRACE(k_seed);
    constexpr std::size_t k_walkers = 20000;
    constexpr double k_step = 0.1;
    const Vec2 drift(0.02, 0.01);
    RandomStream random(k_seed, RandomPurpose::test);
    for (const int steps : {4, 16}) {
        std::vector<Vec2> moved(k_walkers, Vec2::Zero());
        for (Vec2& d : moved) {
            for (int k = 0; k < steps; ++k) {
                const double angle = 2.0 * std::numbers::pi * random.uniform();
                d += drift + k_step * Vec2(std::cos(angle), std::sin(angle));
            }
        }
        // The relative error of a variance is about sqrt(1 / walkers) here, 0.7 %.
        EXPECT_NEAR(displacement_variance(moved), steps * k_step * k_step, 0.03 * steps * k_step * k_step) << steps;
    }
}

TEST(CellFields, HaveMeanVelocityAndGranularTemperatureOfEachCell) {
    CellField field(0.1);
    field.add({0.05, 0.02}, {1.0, 2.0});
    field.add({0.08, 0.09}, {3.0, -2.0});
    field.add({-0.01, 0.05}, {0.0, 5.0});
    const std::vector<CellField::Cell> cells = field.cells();
    ASSERT_EQ(cells.size(), 2U);
    EXPECT_NEAR((cells[0].middle - Vec2(-0.05, 0.05)).norm(), 0.0, 1e-15);
    EXPECT_EQ(cells[0].temperature, 0.0) << "one visit";
    EXPECT_NEAR((cells[1].middle - Vec2(0.05, 0.05)).norm(), 0.0, 1e-15);
    EXPECT_EQ(cells[1].count, 2.0);
    EXPECT_EQ(cells[1].velocity, Vec2(2.0, 0.0));
    EXPECT_DOUBLE_EQ(cells[1].speed, 0.5 * (std::sqrt(5.0) + std::sqrt(13.0)));
    EXPECT_DOUBLE_EQ(cells[1].temperature, 0.5 * (1.0 + 4.0)) << "half of (1^2 + 2^2) about the mean (2, 0)";
}

TEST(SpeedDifference, IsThatOfTheCellsThatBothHave) {
    CellField one(1.0), other(1.0);
    one.add({0.5, 0.5}, {3.0, 0.0});
    one.add({7.5, 0.5}, {9.0, 0.0});
    other.add({0.5, 0.5}, {2.0, 0.0});
    other.add({4.5, 0.5}, {1.0, 0.0});
    EXPECT_DOUBLE_EQ(speed_difference(one.cells(), other.cells()), 0.5);
    EXPECT_EQ(speed_difference(one.cells(), one.cells()), 0.0);
}

TEST(RankCorrelation, GoesByTheOrderAlone) {
    EXPECT_DOUBLE_EQ(rank_correlation({1.0, 2.0, 3.0, 4.0}, {1.0, 10.0, 100.0, 1000.0}), 1.0);
    EXPECT_DOUBLE_EQ(rank_correlation({1.0, 2.0, 3.0}, {7.0, 5.0, -1.0}), -1.0);
    // 1 - 6 sum d^2 / (n (n^2 - 1)) with d = 0, 1, 1, 0.
    EXPECT_DOUBLE_EQ(rank_correlation({1.0, 2.0, 3.0, 4.0}, {1.0, 3.0, 2.0, 4.0}), 1.0 - 12.0 / 60.0);
    // Ranks 1.5 1.5 3 against 1 2 3: covariance 1.5 over sqrt(1.5 * 2).
    EXPECT_DOUBLE_EQ(rank_correlation({0.0, 0.0, 5.0}, {1.0, 2.0, 3.0}), 1.5 / std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(rank_correlation({1.0, std::nan(""), 3.0}, {1.0, 0.0, 2.0}), 1.0) << "left out";
    EXPECT_TRUE(std::isnan(rank_correlation({1.0, 1.0}, {1.0, 2.0})));
    EXPECT_TRUE(std::isnan(rank_correlation({}, {})));
}

/// Grains that go round an arm as a stone on a string, once a turn: one stays in its arm, one passes through both.
MixerTrack round_the_arms() {
    MixerTrack track;
    track.place.resize(2);
    track.velocity.resize(2);
    track.period = 2.0;
    const double turn = 2.0 * std::numbers::pi / track.period;
    for (int k = 0; k < 700; ++k) {
        const double t = 2.0 + 0.02 * k + 1e-4;
        track.time.push_back(t);
        const double up = 0.08 - 0.06 * std::cos(turn * t);
        track.place[0].emplace_back(0.05, up);
        track.velocity[0].emplace_back(0.0, 0.06 * turn * std::sin(turn * t));
        track.place[1].emplace_back(0.05 * std::cos(turn * t), up);
        track.velocity[1].emplace_back(-0.05 * turn * std::sin(turn * t), 0.06 * turn * std::sin(turn * t));
    }
    return track;
}

TEST(MixerRuns, AreMeasuredByTheMotionOfTheirGrains) {
    const MixerRun run = measure_mixer(round_the_arms());
    EXPECT_NEAR(run.exchange, 1.0, 0.03) << "one of two grains, there and back in each turn";
    EXPECT_NEAR(run.exchange_dividing, 0.5, 0.05) << "at a quarter and at three quarters of the turn";
    // Above 60 mm while 0.08 - 0.06 cos > 0.06, i.e. cos < 1/3.
    EXPECT_NEAR(run.circulation, 2.0 * (1.0 - std::acos(1.0 / 3.0) / std::numbers::pi), 2e-3);
    EXPECT_GT(run.speed, 0.06 * 4.0 / 2.0) << "at least four amplitudes in a turn";
    EXPECT_LT(run.speed, 0.08 * 2.0 * std::numbers::pi / 2.0);
}

TEST(MixerRuns, DivideInTheFirstHalfOfATurn) {
    EXPECT_TRUE(divides(3.0, 1.0) && divides(3.49, 1.0) && divides(2.9, 2.0));
    EXPECT_FALSE(divides(3.5, 1.0) || divides(3.99, 1.0) || divides(3.1, 2.0));
}

TEST(MixerPieces, CarryTheParametersOfTheirSet) {
    const std::string h = mixer_piece(k_mixer_sets[7], 2).scenario;
    EXPECT_THAT(h, ::testing::HasSubstr("stiffness = 500000")) << "1000 N/m over 2 mm";
    const std::string b = mixer_piece(k_mixer_sets[1], 2).scenario;
    EXPECT_THAT(b, ::testing::HasSubstr("stiffness = 250000"));
    EXPECT_NE(mixer_piece(k_mixer_sets[0], 1).scenario, h);
    // g / (2 pi f)^2 and g / (2 pi f) at half a turn a second.
    const std::string slow = mixer_piece(k_mixer_sets[0], 1, 30.0).scenario;
    EXPECT_THAT(slow, ::testing::HasSubstr("amplitude = 0.99396"));
    EXPECT_THAT(slow, ::testing::HasSubstr("velocity = [0.0, 3.12261"));
    EXPECT_EQ(mixer_pieces().size(), 32U) << "eight sets: two seeds, and two more speeds";
    EXPECT_NE(mixer_piece(k_mixer_sets[0], 1).name, mixer_piece(k_mixer_sets[1], 1).name);
}

}  // namespace
}  // namespace polargrain
