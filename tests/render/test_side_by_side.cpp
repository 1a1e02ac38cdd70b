#include <gtest/gtest.h>

#include "render/side_by_side.h"
#include "tests/record/small_scene.h"
#include "tests/render/pixels.h"

namespace polargrain {
namespace {

using testing::content;
using testing::difference;
using testing::k_ground_colour;
using testing::Pixels;
using testing::TemporaryFolder;

FrameStyle style_of(double view_height) {
    FrameStyle style;
    style.title = "Two ways";
    style.view = {Vec2(0.0, 0.0), Vec2(1.0, view_height)};
    return style;
}

Scene disk_at(double x, double y) {
    Scene scene;
    scene.materials.add({"stone", 2500.0, {}, 0.5});
    scene.add(std::make_shared<const Shape>(Disk("ball", 0.1)));
    scene.add(Grain{0, 0, {x, y}, 0.0, Vec2::Zero(), 0.0});
    return scene;
}

/// Pixels that show the dark fill of a resting grain, in the left and the right half or the upper and the lower one.
std::pair<int, int> count_dark(const Pixels& pixels, bool beside) {
    int first = 0, second = 0;
    for (int y = 0; y < pixels.height(); y += 2) {
        for (int x = 0; x < pixels.width(); x += 2) {
            const Colour c = pixels.at({x + 0.5, y + 0.5});
            if (difference(c, colour_anchors(ColourBy::speed).front()) > 0.01) continue;
            ((beside ? 2 * x < pixels.width() : 2 * y < pixels.height()) ? first : second) += 1;
        }
    }
    return {first, second};
}

TEST(SideBySide, SheetsAreEvenAndGrowWithTheNumberOfViews) {
    for (const double height : {0.2, 0.6, 1.0, 2.5}) {
        const FrameStyle two = side_by_side_style(style_of(height), 2);
        const FrameStyle four = side_by_side_style(style_of(height), 4);
        for (const FrameStyle& style : {two, four}) {
            EXPECT_EQ(style.width % 2, 0);
            EXPECT_EQ(style.height % 2, 0);
            EXPECT_LE(style.width, 1920);
            EXPECT_LE(style.height, 1602);
        }
        if (height < 0.5) {
            EXPECT_GT(four.height, two.height) << "wide views stand one below the other";
        } else {
            EXPECT_LT(four.height / static_cast<double>(four.width), two.height / static_cast<double>(two.width));
        }
    }
}

TEST(SideBySide, EveryViewShowsItsOwnGrains) {
    const TemporaryFolder folder("side-by-side");
    for (const double height : {1.0, 0.3}) {
        const Scene there = disk_at(0.5, 0.15);
        const Scene away = disk_at(5.0, 5.0);
        const World world_there = initial_world(there);
        const World world_away = initial_world(away);
        const StepReport report;
        const FrameStyle style = side_by_side_style(style_of(height), 2);
        const auto path = folder / "both.png";
        const auto draw = [&](const Scene& a, const World& wa, const Scene& b, const World& wb) {
            draw_side_by_side(
                std::vector<NamedPicture>{{"a", picture_of(a, wa, report)}, {"b", picture_of(b, wb, report)}}, style,
                path);
            const Pixels pixels(path);
            EXPECT_EQ(pixels.width(), style.width);
            EXPECT_EQ(pixels.height(), style.height);
            return count_dark(pixels, height == 1.0);
        };
        // The legend's own dark end counts with the last half.
        const auto [none_first, none_second] = draw(away, world_away, away, world_away);
        const auto [first, second] = draw(there, world_there, away, world_away);
        EXPECT_GT(first - none_first, 500);
        EXPECT_EQ(second, none_second);
        const auto [still_none, of_second] = draw(away, world_away, there, world_there);
        EXPECT_EQ(still_none, none_first);
        EXPECT_GT(of_second - none_second, 500);
        const std::string once = content(path);
        draw(away, world_away, there, world_there);
        EXPECT_EQ(content(path), once);
    }
}

}  // namespace
}  // namespace polargrain
