#include <gtest/gtest.h>

#include "render/colour_map.h"
#include "render/frame_style.h"
#include "render/round_number.h"
#include "src/core/error.h"
#include "src/core/random.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::small_scene;

TEST(FrameStyleOfAScene, ShowsAllGrainsAndAllThatWallsReach) {
    const Scene scene = small_scene();
    const View view = make_frame_style({}, scene, "").view;
    EXPECT_LT(view.lower.x(), -0.012) << "the shaker goes 2 mm to the left of -0.01";
    EXPECT_GT(view.upper.x(), 0.25) << "the paddle lies to the right";
    EXPECT_GT(view.upper.y(), 0.1) << "the paddle, 5 cm long and pivoted at 5 cm, comes to stand upright";
    EXPECT_LT(view.lower.y(), 0.0);
}

TEST(FrameStyleOfAScene, AFollowedWallCountsWhereItIsAtRest) {
    Scene scene;
    scene.walls.push_back({"vessel", 0, {{0.0, 0.0}, {1.0, 1.0}}, SineMotion{Vec2::UnitY(), 5.0, 1.0, 0.0}, {}});
    FrameSettings settings;
    EXPECT_LT(make_frame_style(settings, scene, "").view.lower.y(), -5.0);
    settings.follow = "vessel";
    const FrameStyle style = make_frame_style(settings, scene, "");
    EXPECT_EQ(style.follow, 0);
    EXPECT_NEAR(style.view.lower.y(), -0.04, 1e-12) << "the margin";
    settings.follow = "vesel";
    EXPECT_THROW(make_frame_style(settings, scene, ""), InputError);
}

TEST(FrameStyleOfAScene, ShowsWhereAWallStops) {
    Scene scene;
    scene.walls.push_back({"gate", 0, {{0.0, 0.0}, {1.0, 1.0}}, LinearMotion{{0.0, 2.0}, 0.5, 3.0}, {}});
    EXPECT_GT(make_frame_style({}, scene, "").view.upper.y(), 6.0);
    scene.walls[0].motion = LinearMotion{{0.0, 2.0}, 0.5, std::nullopt};
    EXPECT_LT(make_frame_style({}, scene, "").view.upper.y(), 1.1) << "nobody knows how far it goes";
}

TEST(FrameStyleOfAScene, TakesTheViewThatIsGiven) {
    FrameSettings settings;
    settings.view = {Vec2(-1.0, 0.5), Vec2(2.0, 1.5)};
    const View view = make_frame_style(settings, small_scene(), "").view;
    EXPECT_EQ(view.lower, Vec2(-1.0, 0.5));
    EXPECT_EQ(view.upper, Vec2(2.0, 1.5));
}

TEST(FrameStyleOfAScene, HeightFollowsFromTheViewWithinBounds) {
    FrameSettings settings;
    settings.width = 1000;
    const auto height_of = [&](double view_width, double view_height) {
        settings.view = {Vec2(0.0, 0.0), Vec2(view_width, view_height)};
        return make_frame_style(settings, small_scene(), "").height;
    };
    EXPECT_EQ(height_of(1.0, 0.001), 200);
    EXPECT_EQ(height_of(1.0, 9.0), 1334);
    EXPECT_GT(height_of(1.0, 0.6), height_of(1.0, 0.5));
    EXPECT_EQ(height_of(1.0, 0.6) % 2, 0);
}

TEST(FrameStyleOfAScene, TheSpeedScaleEndsAtARoundNumberAboveAFallOfTheSceneItself) {
    Scene scene = small_scene();
    for (const double gravity : {0.1, 1.0, 9.81}) {
        scene.gravity = {0.0, -gravity};
        const FrameStyle style = make_frame_style({}, scene, "");
        const double fall = std::sqrt(2.0 * gravity * largest_drop(scene).height);
        EXPECT_GE(style.colour_max, 0.4 * fall * (1.0 - 1e-9));
        EXPECT_EQ(style.colour_max, round_up(style.colour_max)) << "round";
        EXPECT_EQ(style.colour_min, 0.0);
    }
}

TEST(FrameStyleOfAScene, AGivenColourMaximumIsKept) {
    FrameSettings settings;
    settings.colour_max = 0.37;
    EXPECT_EQ(make_frame_style(settings, small_scene(), "").colour_max, 0.37);
    settings.colour = "spin";
    EXPECT_EQ(make_frame_style(settings, small_scene(), "").colour_min, -0.37) << "spin goes both ways";
}

TEST(FrameStyleOfAScene, SizeGoesFromTheLeastToTheGreatestGrain) {
    FrameSettings settings;
    settings.colour = "size";
    const Scene scene = small_scene();
    const FrameStyle style = make_frame_style(settings, scene, "");
    EXPECT_EQ(style.colour_min, 0.01);
    EXPECT_EQ(style.colour_max, outer_radius(scene.shape(2)));
}

TEST(FrameStyleOfAScene, AnEmptySceneHasAStyleToo) {
    const FrameStyle style = make_frame_style({}, Scene{}, "");
    EXPECT_GT(style.view.width(), 0.0);
    EXPECT_GT(style.colour_max, style.colour_min);
}

TEST(ColourBy, AnUnknownWordIsAnsweredWithTheNearest) {
    EXPECT_EQ(colour_by("kinetic_energy"), ColourBy::kinetic_energy);
    try {
        colour_by("sped");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("\"speed\""), std::string::npos) << error.what();
    }
}

TEST(ColourMap, AmountsGrowBrighterAllTheWay) {
    const auto anchors = colour_anchors(ColourBy::speed);
    for (int k = 0; k < 100; ++k) {
        EXPECT_LT(brightness(colour_at(anchors, k / 100.0)), brightness(colour_at(anchors, (k + 1) / 100.0))) << k;
    }
}

TEST(ColourMap, AnglesEndAsTheyBegin) {
    const auto anchors = colour_anchors(ColourBy::angle);
    EXPECT_EQ(brightness(anchors.front()), brightness(anchors.back()));
}

TEST(ColourMap, BeyondTheEndsTheEndColoursStand) {
    const auto anchors = colour_anchors(ColourBy::speed);
    EXPECT_EQ(colour_at(anchors, -3.0).r, anchors.front().r);
    EXPECT_EQ(colour_at(anchors, 7.0).r, anchors.back().r);
}

TEST(RoundNumber, IsNextToWhatWasGiven) {
    constexpr std::uint64_t k_seed = 11;
    RandomStream random(k_seed, RandomPurpose::test);
    for (int k = 0; k < 1000; ++k) {
        const double x = std::pow(10.0, random.uniform(-6.0, 6.0));
        EXPECT_GE(round_up(x), x * (1.0 - 1e-9)) << "seed " << k_seed;
        EXPECT_LE(round_up(x), x * 1.5 * (1.0 + 1e-9)) << "seed " << k_seed;
        EXPECT_LE(round_down(x), x * (1.0 + 1e-9)) << "seed " << k_seed;
        EXPECT_GE(round_down(x), x / 2.5 * (1.0 - 1e-9)) << "seed " << k_seed;
    }
    EXPECT_DOUBLE_EQ(round_up(0.3), 0.3);
    EXPECT_DOUBLE_EQ(round_down(0.049), 0.02);
}

TEST(Ticks, AreFewRoundAndWithinTheScale) {
    constexpr std::uint64_t k_seed = 12;
    RandomStream random(k_seed, RandomPurpose::test);
    for (int k = 0; k < 1000; ++k) {
        const double low = random.uniform(-10.0, 10.0);
        const double high = low + std::pow(10.0, random.uniform(-3.0, 3.0));
        const std::vector<double> values = ticks(low, high, 6);
        ASSERT_GE(values.size(), 1u) << "seed " << k_seed << ", " << low << " to " << high;
        ASSERT_LE(values.size(), 6u) << "seed " << k_seed << ", " << low << " to " << high;
        for (const double value : values) {
            EXPECT_GE(value, low - 1e-6 * (high - low));
            EXPECT_LE(value, high + 1e-6 * (high - low));
        }
    }
}

TEST(LengthText, UsesTheUnitThatPeopleUse) {
    EXPECT_EQ(length_text(2.0), "2 m");
    EXPECT_EQ(length_text(0.1), "10 cm");
    EXPECT_EQ(length_text(0.005), "5 mm");
    EXPECT_EQ(length_text(2e-5), "20 \u00b5m");
}

}  // namespace
}  // namespace polargrain
