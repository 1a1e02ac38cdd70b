#include <gtest/gtest.h>

#include "render/contact_sheet.h"
#include "render/frame.h"
#include "render/frames_sink.h"
#include "render/shape_picture.h"
#include "src/core/error.h"
#include "src/record/trajectory_h5.h"
#include "tests/record/small_scene.h"
#include "tests/record/synced_files.h"
#include "tests/render/pixels.h"

namespace polargrain {
namespace {

using testing::content;
using testing::Pixels;
using testing::small_scene;
using testing::TemporaryFolder;

constexpr int k_frames = 6;

void feed(Sink& sink, const Scene& scene) {
    sink.begin(scene, testing::run_info());
    for (int f = 0; f < k_frames; ++f) {
        const StepReport report = testing::report_at(scene, 4 * f);
        sink.sample({scene, testing::world_at(scene, 4 * f, 0.001), report, Totals{}});
    }
    sink.end();
}

FrameSettings small_frames() {
    FrameSettings settings;
    settings.width = 320;
    settings.every = 0.004;
    return settings;
}

TEST(FramesSink, NumbersTheFramesAndTellsTheirTimes) {
    const TemporaryFolder folder("frames");
    FramesSink sink(folder / "frames", small_frames());
    feed(sink, small_scene());
    EXPECT_EQ(sink.count(), k_frames);
    const auto rows = testing::csv_rows(folder / "frames/index.csv");
    ASSERT_EQ(rows.size(), 1u + k_frames);
    EXPECT_EQ(rows[0], (std::vector<std::string>{"file", "time", "step"}));
    EXPECT_EQ(rows[3], (std::vector<std::string>{"000002.png", "0.008", "8"}));
    for (int f = 0; f < k_frames; ++f) {
        EXPECT_TRUE(Pixels(folder / ("frames/" + rows[static_cast<std::size_t>(f) + 1][0])).valid()) << f;
    }
}

TEST(FramesSink, APowerCutLosesNoFrameOfARunThatHasComeToItsEnd) {
    const TemporaryFolder folder("frames-power-cut");
    FramesSink sink(folder / "frames", small_frames());
    feed(sink, small_scene());
    for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
        EXPECT_TRUE(testing::is_on_disk(entry.path())) << entry.path();
    }
    EXPECT_EQ(testing::synced_files()[(folder / "frames").string()], 1U + k_frames) << "the names of all of them";
}

TEST(FramesSink, AFolderThatCannotBeMadeIsNamed) {
    FramesSink sink("/proc/no/frames", small_frames());
    EXPECT_THROW(sink.begin(small_scene(), testing::run_info()), RunError);
}

TEST(Recording, DrawsTheSameBytesAsTheRunDid) {
    const TemporaryFolder folder("frames-recorded");
    const Scene scene = small_scene();
    FrameSettings settings = small_frames();
    settings.contacts = true;
    FramesSink frames(folder / "frames", settings);
    feed(frames, scene);
    TrajectoryH5 trajectory(folder / "trajectory.h5", 0.004, {});
    feed(trajectory, scene);
    const TrajectoryReader recording(folder / "trajectory.h5");
    const FrameStyle style = make_frame_style(settings, scene, recording.title());
    const StoredFrame frame = recording.frame(4);
    draw_frame(picture_of(recording.scene(), frame), style, folder / "again.png");
    EXPECT_EQ(content(folder / "again.png"), content(folder / "frames/000004.png"));
}

TEST(ContactSheet, HoldsFramesOfAFolderAtTheWidthAskedFor) {
    const TemporaryFolder folder("sheet");
    FramesSink frames(folder / "frames", small_frames());
    feed(frames, small_scene());
    ContactSheetSettings settings;
    settings.width = 900;
    contact_sheet(folder / "frames", folder / "sheet.png", settings);
    const Pixels sheet(folder / "sheet.png");
    ASSERT_TRUE(sheet.valid());
    EXPECT_NEAR(sheet.width(), 900, 12);
    EXPECT_EQ(sheet.height() % 2, 0);
    settings.columns = k_frames;  // all in one row
    contact_sheet(folder / "frames", folder / "row.png", settings);
    EXPECT_LT(Pixels(folder / "row.png").height(), sheet.height());
}

TEST(ContactSheet, IsDrawnFromARecordingToo) {
    const TemporaryFolder folder("sheet-recorded");
    const Scene scene = small_scene();
    TrajectoryH5 trajectory(folder / "trajectory.h5", 0.004, {});
    feed(trajectory, scene);
    const TrajectoryReader recording(folder / "trajectory.h5");
    contact_sheet(recording, make_frame_style({}, recording.scene(), recording.title()), folder / "sheet.png");
    EXPECT_TRUE(Pixels(folder / "sheet.png").valid());
}

TEST(ContactSheet, SaysWhatIsMissing) {
    const TemporaryFolder folder("sheet-missing");
    EXPECT_THROW(contact_sheet(folder / "frames", folder / "sheet.png"), InputError);
    FrameSettings settings = small_frames();
    settings.format = "svg";
    FramesSink frames(folder / "frames", settings);
    feed(frames, small_scene());
    EXPECT_THROW(contact_sheet(folder / "frames", folder / "sheet.png"), InputError) << "SVG frames cannot be tiled";
}

TEST(ShapePicture, ShowsTheInsideTintedAndTheDentWhite) {
    const TemporaryFolder folder("shape");
    const Shape shape = testing::bracket(1.0);
    draw_shape(shape, describe_shape(shape), folder / "shape.png", 600);
    const Pixels pixels(folder / "shape.png");
    ASSERT_TRUE(pixels.valid());
    EXPECT_EQ(pixels.width(), 600);
    // The centre of mass stands in the middle of the square at the left; R_max is 1 / 1.16 of half its side.
    const double scale = 0.5 * pixels.height() / (1.16 * outer_radius(shape));
    const auto at = [&](double x, double y) {
        return pixels.at({0.5 * pixels.height() + scale * x, 0.5 * pixels.height() - scale * y});
    };
    EXPECT_LT(at(-0.4, -0.5).r, 0.95) << "inside";
    EXPECT_GT(at(0.45, 0.45).r, 0.99) << "in the dent";
}

TEST(ShapePicture, PropertiesAreThoseOfTheShape) {
    const std::vector<std::string> lines = describe_shape(Disk("ball", 0.5));
    EXPECT_EQ(lines[0], "area 0.7854 m\u00b2");
    EXPECT_EQ(lines.back(), "a true circle");
    EXPECT_EQ(describe_shape(testing::bracket(1.0)).back(), "6 vertices");
}

}  // namespace
}  // namespace polargrain
