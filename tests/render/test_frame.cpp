#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "render/frame.h"
#include "render/shape_picture.h"
#include "src/core/error.h"
#include "tests/record/small_scene.h"
#include "tests/render/pixels.h"

namespace polargrain {
namespace {

using testing::content;
using testing::difference;
using testing::k_alike;
using testing::k_ground_colour;
using testing::Pixels;
using testing::TemporaryFolder;

/// A view of one metre by one, one disk of radius 0.2 in its middle.
Scene one_disk(double angle = 0.0, const Vec2& velocity = Vec2::Zero()) {
    Scene scene;
    scene.materials.add({"stone", 2500.0, {}, 0.5});
    scene.add(std::make_shared<const Shape>(Disk("ball", 0.2)));
    scene.add(Grain{0, 0, {0.5, 0.5}, angle, velocity, 0.0});
    return scene;
}

FrameStyle unit_view() {
    FrameStyle style;
    style.view = {Vec2(0.0, 0.0), Vec2(1.0, 1.0)};
    style.width = 400;
    style.height = 440;
    return style;
}

/// Where a point of the plane is on the paper.
Vec2 on_paper(const FrameStyle& style, const Vec2& world) {
    const Rect sheet{0.0, 0.0, static_cast<double>(style.width), static_cast<double>(style.height)};
    return Projection(style.view, frame_layout(sheet).plot)(world);
}

class Frame : public ::testing::Test {
protected:
    Frame() : folder_("frame") {}

    const Pixels& draw(const Scene& scene, const FrameStyle& style, double time = 0.0,
                       const StepReport& report = StepReport{}) {
        World world = initial_world(scene);
        world.time = time;
        const std::filesystem::path path = folder_ / "frame.png";
        draw_frame(picture_of(scene, world, report), style, path);
        style_ = style;
        return pixels_.emplace(path);
    }
    Colour at(double x, double y) const { return pixels_->at(on_paper(style_, {x, y})); }

    TemporaryFolder folder_;
    FrameStyle style_;
    std::optional<Pixels> pixels_;
};

TEST_F(Frame, AGrainHasTheColourOfItsSpeedAndTheGroundHasNone) {
    for (const double speed : {0.0, 0.3, 0.77, 1.0, 5.0}) {
        draw(one_disk(0.0, {0.0, -speed}), unit_view());
        const Colour expected = colour_at(colour_anchors(ColourBy::speed), speed);
        EXPECT_LT(difference(at(0.4, 0.5), expected), k_alike) << "speed " << speed;
        EXPECT_LT(difference(at(0.5, 0.8), k_ground_colour), k_alike);
    }
}

TEST_F(Frame, TheOrientationMarkTurnsWithTheGrain) {
    for (const double angle : {0.0, 0.9, 2.5, -1.3}) {
        draw(one_disk(angle), unit_view());
        const Colour fill = colour_at(colour_anchors(ColourBy::speed), 0.0);
        const Vec2 along = Pose::at(Vec2::Zero(), angle).turned(Vec2::UnitX());
        const Vec2 ahead = Vec2(0.5, 0.5) + 0.1 * along, behind = Vec2(0.5, 0.5) - 0.1 * along;
        EXPECT_GT(difference(at(ahead.x(), ahead.y()), fill), 0.2) << "angle " << angle;
        EXPECT_LT(difference(at(behind.x(), behind.y()), fill), k_alike) << "angle " << angle;
    }
}

TEST_F(Frame, ADentStaysADent) {
    Scene scene = one_disk();
    scene.grains.shape[0] = scene.add(std::make_shared<const Shape>(testing::bracket(0.2)));
    draw(scene, unit_view());
    // The corner of the L is at (1, 1) - (5/6, 5/6) times 0.2 from the centre; beyond it the ground shows.
    EXPECT_LT(difference(at(0.5 + 0.1, 0.5 + 0.1), k_ground_colour), k_alike);
    EXPECT_GT(difference(at(0.5 - 0.1, 0.5 - 0.1), k_ground_colour), 0.2);
}

TEST_F(Frame, AWallIsSolidOnItsRight) {
    Scene scene;
    scene.walls.push_back({"floor", 0, {{0.1, 0.5}, {0.9, 0.5}}, {}, {}});
    draw(scene, unit_view());
    EXPECT_LT(brightness(at(0.5, 0.5)), 0.5) << "the line itself";
    EXPECT_LT(difference(at(0.5, 0.52), k_ground_colour), k_alike) << "free side";
    EXPECT_GT(difference(at(0.5, 0.488), k_ground_colour), 0.05) << "solid side";
    std::reverse(scene.walls[0].points.begin(), scene.walls[0].points.end());
    draw(scene, unit_view());
    EXPECT_GT(difference(at(0.5, 0.512), k_ground_colour), 0.05) << "solid side";
    EXPECT_LT(difference(at(0.5, 0.48), k_ground_colour), k_alike) << "free side";
}

TEST_F(Frame, AChainThatGoesRoundItsSolidSideIsFilled) {
    Scene scene;
    scene.walls.push_back({"block", 0, {{0.3, 0.3}, {0.3, 0.7}, {0.7, 0.7}, {0.7, 0.3}, {0.3, 0.3}}, {}, {}});
    draw(scene, unit_view());
    EXPECT_GT(difference(at(0.5, 0.5), k_ground_colour), 0.05);
    EXPECT_LT(difference(at(0.5, 0.75), k_ground_colour), k_alike);
    std::reverse(scene.walls[0].points.begin(), scene.walls[0].points.end());
    draw(scene, unit_view());
    EXPECT_LT(difference(at(0.5, 0.5), k_ground_colour), k_alike) << "a box is empty";
}

TEST_F(Frame, SeveralPiecesLeaveNoStreaksBetweenThem) {
    Scene scene;
    scene.walls.push_back(
        {"bump", 0, {{0.1, 0.9}, {0.1, 0.1}, {0.5, 0.1}, {0.55, 0.15}, {0.6, 0.1}, {0.9, 0.1}}, {}, {}});
    draw(scene, unit_view());
    for (double x = 0.15; x < 0.9; x += 0.05) {
        for (double y = 0.2; y < 0.9; y += 0.05) {
            EXPECT_LT(difference(at(x, y), k_ground_colour), k_alike) << x << ' ' << y;
        }
    }
}

TEST_F(Frame, AMovingWallIsDrawnWhereItIs) {
    Scene scene;
    scene.walls.push_back({"shaker", 0, {{0.5, 0.9}, {0.5, 0.1}}, SineMotion{Vec2::UnitX(), 0.2, 1.0, 0.0}, {}});
    draw(scene, unit_view(), 0.25);  // a quarter of a period: the whole amplitude
    EXPECT_LT(brightness(at(0.7, 0.5)), 0.5);
    EXPECT_LT(difference(at(0.5, 0.5), k_ground_colour), k_alike);
}

TEST_F(Frame, AViewThatFollowsAWallGoesAlongWithItAndDoesNotTurn) {
    Scene scene = one_disk();
    scene.walls.push_back({"shaker", 0, {{0.2, 0.9}, {0.2, 0.1}}, SineMotion{Vec2::UnitX(), 0.2, 1.0, 0.0}, {}});
    scene.walls.push_back({"paddle", 0, {{0.7, 0.2}, {0.9, 0.2}}, RotationMotion{Vec2(0.8, 0.2), 2.0 * k_pi, 0.0}, {}});
    FrameStyle style = unit_view();
    style.follow = 0;
    draw(scene, style, 0.25);  // a quarter of a period: the whole amplitude, to the right
    EXPECT_LT(brightness(at(0.2, 0.5)), 0.5) << "the wall stays where it was on the paper";
    EXPECT_GT(difference(at(0.2, 0.5), at(0.36, 0.5)), 0.2);
    EXPECT_LT(difference(at(0.65, 0.5), k_ground_colour), k_alike) << "and the disk has gone to the left";
    EXPECT_GT(difference(at(0.2, 0.45), k_ground_colour), 0.2);
    style.follow = 1;
    draw(scene, style, 0.25);
    EXPECT_LT(brightness(at(0.8, 0.28)), 0.5) << "the paddle has turned upright about its middle";
    EXPECT_LT(brightness(at(0.4, 0.5)), 0.5) << "the shaker has moved";
}

TEST_F(Frame, ARemovedWallIsGone) {
    Scene scene;
    scene.walls.push_back({"gate", 0, {{0.1, 0.5}, {0.9, 0.5}}, {}, 1.0});
    draw(scene, unit_view(), 0.99);
    EXPECT_LT(brightness(at(0.5, 0.5)), 0.5);
    draw(scene, unit_view(), 1.0);
    EXPECT_LT(difference(at(0.5, 0.5), k_ground_colour), k_alike);
}

TEST_F(Frame, ContactsAreShownOnRequest) {
    const Scene scene;
    StepReport report;
    report.contacts.push_back({0, 1, {0.5, 0.5}, Vec2::UnitX(), 0.0, {1.0, 0.0}});
    FrameStyle style = unit_view();
    draw(scene, style, 0.0, report);
    EXPECT_LT(difference(at(0.5, 0.5), k_ground_colour), k_alike);
    style.contacts = true;
    draw(scene, style, 0.0, report);
    const Colour dot = at(0.5, 0.5);
    EXPECT_GT(dot.r, dot.g + 0.4);
}

TEST_F(Frame, WhatLeavesTheViewDoesNotSpillIntoTheMargins) {
    Scene scene = one_disk();
    FrameStyle style = unit_view();
    draw(Scene{}, style);
    const Colour margin = pixels_->at({3.0, 220.0});
    scene.grains.x[0] = 0.0;  // half of it is out, to the left of the frame's edge
    draw(scene, style);
    EXPECT_LT(difference(pixels_->at({3.0, 220.0}), margin), k_alike);
    EXPECT_GT(difference(at(0.05, 0.45), k_ground_colour), 0.2);
}

TEST_F(Frame, EqualInputDrawsEqualBytes) {
    const Scene scene = testing::small_scene();
    const FrameStyle style = make_frame_style({}, scene, "Twice the same");
    draw(scene, style, 0.005, testing::report_at(scene, 5));
    const std::string first = content(folder_ / "frame.png");
    draw(scene, style, 0.005, testing::report_at(scene, 5));
    EXPECT_EQ(content(folder_ / "frame.png"), first);
    draw(scene, style, 0.006, testing::report_at(scene, 5));
    EXPECT_NE(content(folder_ / "frame.png"), first) << "a millisecond later";
}

TEST_F(Frame, ThePictureHasTheSizeAskedForInEvenPixels) {
    FrameSettings settings;
    settings.width = 641;
    settings.height = 333;
    const Scene scene = testing::small_scene();
    const Pixels& pixels = draw(scene, make_frame_style(settings, scene, "Odd sizes"));
    EXPECT_EQ(pixels.width(), 642);
    EXPECT_EQ(pixels.height(), 334);
}

TEST_F(Frame, AVectorPictureHoldsEveryGrainAsAPath) {
    const Scene scene = testing::small_scene();
    const FrameStyle style = make_frame_style({}, scene, "Vectors");
    const StepReport nothing;
    const auto paths_of = [&](const World& world) {
        draw_frame(picture_of(scene, world, nothing), style, folder_ / "frame.svg");
        const std::string svg = content(folder_ / "frame.svg");
        EXPECT_NE(svg.find("<svg"), std::string::npos);
        int count = 0;
        for (std::size_t k = svg.find("<path"); k != std::string::npos; k = svg.find("<path", k + 1)) ++count;
        return count;
    };
    World world = initial_world(scene);
    const int with_all = paths_of(world);
    world.grains.x[0] = 100.0;  // far out of the view
    EXPECT_EQ(paths_of(world), with_all - 2) << "the grain and its mark";
}

TEST_F(Frame, PdfIsPdf) {
    const Scene scene = testing::small_scene();
    const StepReport nothing;
    draw_frame(picture_of(scene, initial_world(scene), nothing), make_frame_style({}, scene, "Paper"),
               folder_ / "frame.pdf");
    EXPECT_EQ(content(folder_ / "frame.pdf").substr(0, 5), "%PDF-");
}

TEST_F(Frame, FilesThatCannotBeWrittenAreNamed) {
    const Scene scene = testing::small_scene();
    const StepReport nothing;
    const World world = initial_world(scene);
    const FrameStyle style = make_frame_style({}, scene, "Nowhere");
    for (const char* extension : {"png", "svg", "pdf"}) {
        const std::string path = std::string("/nowhere/at/all.") + extension;
        try {
            draw_frame(picture_of(scene, world, nothing), style, path);
            ADD_FAILURE() << "drew into " << path;
        } catch (const RunError& error) {
            EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
        }
    }
    EXPECT_THROW(draw_frame(picture_of(scene, world, nothing), style, folder_ / "frame.gif"), InputError);
}

TEST_F(Frame, AFullDiskIsNoticed) {
    std::filesystem::create_symlink("/dev/full", folder_ / "full.png");
    const Scene scene = testing::small_scene();
    const StepReport nothing;
    EXPECT_THROW(draw_frame(picture_of(scene, initial_world(scene), nothing), unit_view(), folder_ / "full.png"),
                 RunError);
}

TEST(PictureFile, OnAFullDiskIsAnErrorByNameWhateverItsFormat) {
    const testing::TemporaryFolder folder("frame-full");
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    for (const char* name : {"gear.png", "gear.svg", "gear.pdf"}) {
        const rlimit limit{1000, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        std::string message;
        try {
            draw_shape(Disk("ball", 0.01), {"a line"}, folder / name, 400);
        } catch (const RunError& error) {
            message = error.what();
        }
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_NE(message.find(name), std::string::npos) << name << ": " << message;
        EXPECT_FALSE(std::filesystem::exists(folder / name)) << "half a picture";
    }
    std::signal(SIGXFSZ, previous);
}

}  // namespace
}  // namespace polargrain
