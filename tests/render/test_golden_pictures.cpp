#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "render/painting.h"
#include "tests/record/small_scene.h"
#include "tests/render/pixels.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using testing::Pixels;
using testing::report_at;
using testing::small_scene;
using testing::world_at;

constexpr int k_width = 300, k_height = 180;
/// Versions of Cairo differ in how they smooth edges: this share of the pixels may be another.
constexpr double k_share = 0.002;
constexpr double k_alike = 12.0 / 255.0;

/// Only the plot of a frame: fonts differ from machine to machine, and are not what is held here.
void draw(ColourBy colour, const fs::path& path) {
    const Scene scene = small_scene();
    const World world = world_at(scene, 8, 0.001);
    StepReport report = report_at(scene, 8);
    report.contacts.push_back({0, 1, Vec2(0.035, 0.012), Vec2::UnitX(), 0.0, Vec2(0.02, 0.002)});
    report.contacts.push_back({1, 2, Vec2(0.065, 0.017), Vec2::UnitX(), 0.0, Vec2(0.008, 0.001)});
    FrameStyle style = make_frame_style({}, scene, "", 0.001);
    style.colour = colour;
    style.view = {{-0.02, -0.01}, {0.16, 0.09}};
    style.contacts = colour == ColourBy::speed;
    std::tie(style.colour_min, style.colour_max) =
        colour == ColourBy::spin ? std::pair{-3.0, 3.0} : std::pair{0.0, colour == ColourBy::contacts ? 8.0 : 0.4};
    style.chain_scale = 0.03;
    Canvas canvas(path, k_width, k_height);
    draw_plot(canvas.context(), picture_of(scene, world, report), style, canvas.sheet(), 10.0);
    canvas.finish();
}

/// Marks in red what differs, over the expected picture, in pale.
double compare(const Pixels& expected, const Pixels& found, const fs::path& difference_picture) {
    Canvas marks(difference_picture, k_width, k_height);
    int different = 0;
    for (int y = 0; y < k_height; ++y) {
        for (int x = 0; x < k_width; ++x) {
            const Vec2 at(x + 0.5, y + 0.5);
            const bool alike = testing::difference(expected.at(at), found.at(at)) <= k_alike;
            different += alike ? 0 : 1;
            const Colour& c = expected.at(at);
            set_colour(marks.context(),
                       alike ? Colour{0.7 + 0.3 * c.r, 0.7 + 0.3 * c.g, 0.7 + 0.3 * c.b} : Colour{0.9, 0.0, 0.0});
            cairo_rectangle(marks.context(), x, y, 1.0, 1.0);
            cairo_fill(marks.context());
        }
    }
    marks.finish();
    return static_cast<double>(different) / (k_width * k_height);
}

struct Case {
    const char* name;
    ColourBy colour;
};

class GoldenPicture : public ::testing::TestWithParam<Case> {};

TEST_P(GoldenPicture, IsDrawnAsBefore) {
    const std::string name = GetParam().name;
    const fs::path golden = fs::path(POLARGRAIN_SOURCE_DIR) / "tests/golden/pictures" / (name + ".png");
    if (std::getenv("POLARGRAIN_RENEW_GOLDENS") != nullptr) {
        fs::create_directories(golden.parent_path());
        draw(GetParam().colour, golden);
        return;
    }
    const fs::path folder = fs::path(POLARGRAIN_BINARY_DIR) / "golden-pictures";
    fs::create_directories(folder);
    const fs::path drawn = folder / (name + ".png"), difference = folder / (name + "-difference.png");
    draw(GetParam().colour, drawn);
    const Pixels expected(golden), found(drawn);
    ASSERT_TRUE(expected.valid()) << golden << " is missing: scripts/renew-goldens writes it";
    ASSERT_EQ(expected.width(), k_width);
    ASSERT_EQ(expected.height(), k_height);
    const double share = compare(expected, found, difference);
    if (share <= k_share) fs::remove(difference);
    EXPECT_LE(share, k_share) << "expected " << golden << "\nfound    " << drawn << "\nmarked   " << difference;
}

TEST(GoldenPictures, ADifferenceIsSeen) {
    const fs::path folder = fs::path(POLARGRAIN_BINARY_DIR) / "golden-pictures";
    fs::create_directories(folder);
    draw(ColourBy::speed, folder / "a.png");
    draw(ColourBy::spin, folder / "b.png");
    const Pixels a(folder / "a.png"), b(folder / "b.png");
    EXPECT_EQ(compare(a, a, folder / "none.png"), 0.0);
    EXPECT_GT(compare(a, b, folder / "some.png"), 5.0 * k_share);
}

INSTANTIATE_TEST_SUITE_P(Colours, GoldenPicture,
                         ::testing::Values(Case{"speed", ColourBy::speed}, Case{"spin", ColourBy::spin},
                                           Case{"shape", ColourBy::shape}, Case{"contacts", ColourBy::contacts},
                                           Case{"force", ColourBy::force}),
                         [](const auto& picture) { return std::string(picture.param.name); });

}  // namespace
}  // namespace polargrain
