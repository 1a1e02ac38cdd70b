#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "src/core/error.h"
#include "src/plot/gnuplot_script.h"
#include "src/plot/plot.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Plots : public ::testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path stem() const { return folder_ / "figure"; }
    fs::path file(const char* extension) const { return stem().string() + extension; }

    fs::path folder_ = fs::path(::testing::TempDir()) /
                       ("plots-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

struct Pixels {
    png_image image{};
    std::vector<png_byte> rgb;
    explicit Pixels(const fs::path& path) {
        image.version = PNG_IMAGE_VERSION;
        EXPECT_TRUE(png_image_begin_read_from_file(&image, path.c_str())) << path;
        image.format = PNG_FORMAT_RGB;
        rgb.resize(PNG_IMAGE_SIZE(image));
        EXPECT_TRUE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr));
    }
    /// Pixels of about this colour.
    int count(int r, int g, int b) const {
        int found = 0;
        for (std::size_t k = 0; k + 2 < rgb.size(); k += 3) {
            found += std::abs(rgb[k] - r) + std::abs(rgb[k + 1] - g) + std::abs(rgb[k + 2] - b) < 30;
        }
        return found;
    }
};

Series line(std::vector<double> x, std::vector<double> y) {
    return {.label = "line", .style = SeriesStyle::line, .x = std::move(x), .y = std::move(y)};
}

Plot one_panel(Series series) {
    Panel panel{.title = "panel", .x_label = "t [s]", .y_label = "λ / h", .series = {std::move(series)}};
    return {.title = "title", .panels = {std::move(panel)}, .width = 600, .height = 400};
}

TEST_F(Plots, BecomeAPictureAVectorFileAndATable) {
    write_plot(one_panel(line({0.0, 1.0, 2.0}, {0.1, 0.25, 1.0 / 3.0})), stem());
    const Pixels picture(file(".png"));
    EXPECT_EQ(picture.image.width, 600U);
    EXPECT_EQ(picture.image.height, 400U);
    // The first colour of the palette, on a line across most of the sheet.
    EXPECT_GT(picture.count(0x00, 0x72, 0xb2), 300);
    EXPECT_THAT(contents(file(".pdf")), StartsWith("%PDF"));
    EXPECT_EQ(contents(file(".csv")),
              "panel,series,x,y,y_error,dx,dy,text,z\n"
              "panel,line,0,0.1,,,,,\npanel,line,1,0.25,,,,,\npanel,line,2,0.3333333333333333,,,,,\n");
    EXPECT_EQ(std::distance(fs::directory_iterator(stem().parent_path()), {}), 3)
        << "the script is only kept where it failed";
}

TEST_F(Plots, DrawEveryStyleOnEveryKindOfAxis) {
    Panel styles{.title = "styles", .levels = {{0.5, "level", false}, {1.5, "there", true}}, .log_y = true};
    for (const SeriesStyle style :
         {SeriesStyle::line, SeriesStyle::dashed, SeriesStyle::points, SeriesStyle::line_points, SeriesStyle::steps,
          SeriesStyle::bars, SeriesStyle::outline, SeriesStyle::filled, SeriesStyle::arrows, SeriesStyle::labels,
          SeriesStyle::cells}) {
        styles.series.push_back({.label = "s",
                                 .style = style,
                                 .x = {1.0, 2.0, 3.0},
                                 .y = {1.0, 10.0, 4.0},
                                 .y_error = {},
                                 .dx = {0.1, 0.1, 0.1},
                                 .dy = {1.0, 1.0, 1.0},
                                 .texts = {"a", "b", "c"},
                                 .z = {1.0, 2.0, 3.0}});
    }
    Panel map = styles;
    map.map = true;
    map.log_y = false;
    Plot plot{.title = "all", .panels = {styles, map}, .columns = 2};
    write_plot(plot, stem());
    EXPECT_GT(Pixels(file(".png")).count(0x00, 0x72, 0xb2), 100);
}

TEST_F(Plots, ColourCellsByTheirValueOnTheScaleOfThePanel) {
    const auto in_the_middle = [&](double value) {
        Panel panel{.series = {{.style = SeriesStyle::cells, .x = {0.0}, .y = {0.0}, .z = {value}, .cell = 2.0}},
                    .x_range = std::pair{-1.0, 1.0},
                    .y_range = std::pair{-1.0, 1.0},
                    .z_range = std::pair{0.0, 10.0},
                    .map = true};
        write_plot({.title = "cells", .panels = {std::move(panel)}, .width = 400, .height = 400}, stem());
        const Pixels picture(file(".png"));
        constexpr std::size_t k = 3U * (std::size_t{200} * 400U + 200U);
        return std::array<int, 3>{picture.rgb[k], picture.rgb[k + 1], picture.rgb[k + 2]};
    };
    const auto lowest = in_the_middle(0.0), highest = in_the_middle(10.0);
    EXPECT_GT(lowest[2], lowest[0]) << "dark blue";
    EXPECT_GT(highest[0] + highest[1], 300) << "yellow";
    EXPECT_LT(highest[2], 100);
    EXPECT_EQ(in_the_middle(25.0), highest) << "values beyond the ends take the end colours";
}

TEST_F(Plots, LeaveOutWhatIsNoNumber) {
    write_plot(one_panel(line({0.0, 1.0, 2.0}, {0.0, std::nan(""), 1.0})), stem());
    EXPECT_THAT(contents(file(".csv")), HasSubstr("line,1,nan"));
    EXPECT_GT(Pixels(file(".png")).count(0x00, 0x72, 0xb2), 300);
}

TEST_F(Plots, ShowAnEmptyPanelWhereThereIsNothingToDraw) {
    write_plot(one_panel(line({}, {})), stem());
    EXPECT_EQ(Pixels(file(".png")).count(0x00, 0x72, 0xb2), 0);
}

TEST_F(Plots, TakeTextsLiterally) {
    Plot plot = one_panel(line({0.0, 1.0}, {0.0, 1.0}));
    plot.title = "it's 5 % of {x}_2 \"quoted\" `pwd`";
    plot.panels[0].series.push_back({.style = SeriesStyle::labels, .x = {0.5}, .y = {0.5}, .texts = {"a \"b\" \\n"}});
    write_plot(plot, stem());
    EXPECT_THAT(contents(file(".csv")), HasSubstr("\"a \"\"b\"\" \\n\""));
}

TEST_F(Plots, DrawErrorBars) {
    Series bare{.style = SeriesStyle::points, .x = {1.0, 2.0}, .y = {1.0, 2.0}};
    Series with_errors = bare;
    with_errors.y_error = {0.4, 0.4};
    Plot plot = one_panel(bare);
    plot.panels[0].y_range = {0.0, 3.0};
    write_plot(plot, stem());
    const int before = Pixels(file(".png")).count(0x00, 0x72, 0xb2);
    plot.panels[0].series[0] = with_errors;
    write_plot(plot, stem());
    EXPECT_GT(Pixels(file(".png")).count(0x00, 0x72, 0xb2), before + 15);
}

TEST_F(Plots, DrawErrorBarsOverBarsWithoutCuttingThemOut) {
    Plot plot = one_panel({.style = SeriesStyle::bars, .x = {1.0, 2.0}, .y = {1.0, 2.0}});
    plot.panels[0].x_range = {0.0, 3.0};
    plot.panels[0].y_range = {0.0, 3.0};
    const auto filled = [&] {
        write_plot(plot, stem());
        return Pixels(file(".png")).count(0xa6, 0xce, 0xe5);
    };
    const int before = filled();
    ASSERT_GT(before, 5000);
    plot.panels[0].series[0].y_error = {1e-9, 1e-9};
    EXPECT_NEAR(filled(), before, 0.005 * before);
}

TEST_F(Plots, WriteNamesInsteadOfNumbersOnThatPanelAlone) {
    Plot plot = one_panel(line({1.0, 2.0}, {1.0, 2.0}));
    plot.panels.push_back(plot.panels.front());
    plot.panels.front().x_names = {"one engine", "another's"};
    write_plot(plot, stem());
    const std::string script = gnuplot_script(plot, file(".png"), file(".pdf"));
    const auto names = script.find("set xtics nomirror out ('one engine' 1, 'another''s' 2)");
    ASSERT_NE(names, std::string::npos) << script;
    EXPECT_NE(script.find("set xtics autofreq", names), std::string::npos) << "the second panel counts again";
}

TEST_F(Plots, DoNotGoBelowZeroWhereNothingLiesThere) {
    const auto script = [&](std::vector<double> y) {
        return gnuplot_script(one_panel(line({4.0, 5.0, 6.0}, std::move(y))), file(".png"), file(".pdf"));
    };
    EXPECT_THAT(script({9.0, 2.0, 0.0}), HasSubstr("set yrange [0:*]"));
    EXPECT_THAT(script({9.0, 2.0, -0.1}), HasSubstr("set yrange [*:*]"));
    EXPECT_THAT(script({9.0, 8.0, 7.0}), HasSubstr("set yrange [*:*]")) << "far from zero, zero is of no interest";
    EXPECT_THAT(script({9.0, 2.0, 0.0}), Not(HasSubstr("set xrange [0:*]")));
}

TEST_F(Plots, RefuseColumnsThatDiffer) {
    EXPECT_THROW(write_plot(one_panel(line({0.0, 1.0}, {0.0})), stem()), InputError);
    EXPECT_THROW(write_plot({.title = "no panels"}, stem()), InputError);
}

TEST_F(Plots, SayWhatToInstallWhereGnuplotIsMissing) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder_.c_str(), 1);
    try {
        require_plotting();
        ADD_FAILURE() << "there is no gnuplot in an empty folder";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), HasSubstr("gnuplot-nox"));
    }
    setenv("PATH", path.c_str(), 1);
    EXPECT_NO_THROW(require_plotting());
}

}  // namespace
}  // namespace polargrain
