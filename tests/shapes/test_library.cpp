#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "shapes/library.h"
#include "shapes/outline.h"
#include "src/core/error.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A folder of its own for one test, gone afterwards; sets and restores POLARGRAIN_DATA.
class OutlineFiles : public ::testing::Test {
protected:
    OutlineFiles() : folder_(fs::temp_directory_path() / fmt::format("polargrain-outlines-{}", ::getpid())) {
        fs::create_directories(folder_);
        if (const char* data = std::getenv("POLARGRAIN_DATA")) data_before_ = data;
        ::unsetenv("POLARGRAIN_DATA");
    }
    ~OutlineFiles() override {
        if (data_before_.empty()) {
            ::unsetenv("POLARGRAIN_DATA");
        } else {
            ::setenv("POLARGRAIN_DATA", data_before_.c_str(), 1);
        }
        fs::remove_all(folder_);
    }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    std::string refusal(const std::string& text) const {
        try {
            (void)read_outline_file(write("it.toml", text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }

    fs::path folder_;
    std::string data_before_;
};

const std::string k_head = "title = \"A grain\"\nsource = \"Drawn for this test\"\n";

TEST_F(OutlineFiles, OfTheLibraryAreAllPossibleGrainsOfTheirOwnSize) {
    const auto library = shape_library();
    EXPECT_GE(library.size(), 10U);
    std::set<std::string> names, titles;
    double least_ratio = 1.0;
    for (const OutlineFile& outline : library) {
        SCOPED_TRACE(outline.name);
        EXPECT_FALSE(outline.title.empty());
        EXPECT_GE(outline.source.size(), 20U) << "say where the outline comes from";
        names.insert(outline.name);
        titles.insert(outline.title);
        const PolarPolygon polygon = prepare_outline(outline.name, outline.points);
        EXPECT_GT(polygon.outer_radius(), 1e-4) << "smaller than fine sand: is the unit right?";
        EXPECT_LT(polygon.outer_radius(), 5e-2) << "larger than a fist: is the unit right?";
        EXPECT_LE(polygon.size(), 64);
        least_ratio = std::min(least_ratio, polygon.inner_radius() / polygon.outer_radius());
    }
    EXPECT_EQ(names.size(), library.size());
    EXPECT_EQ(titles.size(), library.size());
    for (const char* promised :
         {"gravel", "stick", "star", "domino", "gear", "hexagon", "sand-rounded", "sand-angular"}) {
        EXPECT_TRUE(names.contains(promised)) << promised;
    }
    EXPECT_LT(least_ratio, 0.5);
}

TEST_F(OutlineFiles, OfTheLibraryIncludeADeeplyHollowOne) {
    const PolarPolygon gear = prepare_outline("gear", find_outline("gear", folder_).points);
    EXPECT_LT(gear.inner_radius() / gear.outer_radius(), 0.5);
    int hollow_corners = 0;
    for (int q = 0; q < gear.size(); ++q) {
        const Vec2 here = gear.vertex(gear.next(q)) - gear.vertex(q);
        const Vec2 before = gear.vertex(q) - gear.vertex(gear.previous(q));
        hollow_corners += cross(before, here) < -1e-9 * here.norm() * before.norm() ? 1 : 0;
    }
    EXPECT_GE(hollow_corners, 20);
}

TEST_F(OutlineFiles, DominoHasTheDimensionsOfThePaper) {
    const auto mass = mass_properties("domino", find_outline("domino", folder_).points);
    const double w = 7.5e-3, h = 41.8e-3;
    EXPECT_NEAR(mass.area / (w * h), 1.0, 1e-14);
    EXPECT_NEAR(mass.polar_moment / (w * h * (w * w + h * h) / 12.0), 1.0, 1e-12);
}

TEST_F(OutlineFiles, AreFoundByPathFirstAndByNameElse) {
    write("gear", k_head + "points = [[0, 0], [1, 0], [0, 1]]\n");
    fs::create_directories(folder_ / "sub");
    write("sub/mine.toml", k_head + "points = [[0, 0], [2, 0], [0, 1]]\n");
    EXPECT_EQ(find_outline("gear", folder_).points.size(), 3U);
    EXPECT_EQ(find_outline("gear", folder_ / "sub").points.size(), 60U);
    EXPECT_EQ(find_outline("sub/mine.toml", folder_).name, "mine");
    EXPECT_EQ(find_outline((folder_ / "sub/mine.toml").string(), "/").name, "mine");
    try {
        (void)find_outline("sand-anglar", folder_);
        FAIL() << "found";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("did you mean \"sand-angular\"?"));
    }
}

TEST_F(OutlineFiles, LieWhereTheEnvironmentSays) {
    fs::create_directories(folder_ / "shapes/outlines");
    write("shapes/outlines/only.toml", k_head + "points = [[0, 0], [1, 0], [0, 1]]\n");
    ::setenv("POLARGRAIN_DATA", folder_.c_str(), 1);
    ASSERT_EQ(shape_library().size(), 1U);
    EXPECT_EQ(shape_library().front().name, "only");
    ::setenv("POLARGRAIN_DATA", (folder_ / "nowhere").c_str(), 1);
    EXPECT_THROW((void)shape_library(), InputError);
}

TEST_F(OutlineFiles, GivePointsInTheirUnitOrAsRadii) {
    const auto points = [&](const std::string& text) {
        return read_outline_file(write("it.toml", k_head + text)).points;
    };
    const auto square = points("unit = \"mm\"\npoints = [[0, 0], [2.5, 0], [2.5, 1], [0, 1]]\n");
    ASSERT_EQ(square.size(), 4U);
    EXPECT_EQ(square[2], Vec2(1e-3 * 2.5, 1e-3));
    EXPECT_EQ(points("points = [[0, 0], [2, 0], [0, 1]]")[1], Vec2(2.0, 0.0));
    EXPECT_EQ(points("unit = \"um\"\npoints = [[0, 0], [2, 0], [0, 1]]")[1], Vec2(2e-6, 0.0));
    const auto radii = points("unit = \"cm\"\nradii = [1, 2, 1, 2]\n");
    EXPECT_NEAR((radii[1] - Vec2(0.0, 2e-2)).norm(), 0.0, 1e-17);
    const auto polar = points("polar = [[1, 0], [3, 90], [1, 180.0], [2, 270]]\n");
    EXPECT_NEAR((polar[1] - Vec2(0.0, 3.0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((polar[3] - Vec2(0.0, -2.0)).norm(), 0.0, 1e-15);
}

TEST_F(OutlineFiles, SayWhereTheyAreWrongAndHowToMendIt) {
    const std::string points = "points = [[0, 0], [1, 0], [0, 1]]\n";
    EXPECT_THAT(refusal("title = \"no end\nsource"), HasSubstr("it.toml:1:"));
    EXPECT_THAT(refusal(k_head + "pionts = [[0, 0]]\n"),
                HasSubstr("it.toml:3:1: unknown key \"pionts\": did you mean \"points\"?"));
    EXPECT_THAT(refusal("title = \"t\"\n" + points), HasSubstr("add a line source = "));
    EXPECT_THAT(refusal("title = 3\nsource = \"s\"\n" + points),
                HasSubstr("it.toml:1:9: title: give a text in quotes"));
    EXPECT_THAT(refusal(k_head), HasSubstr("give the outline once"));
    EXPECT_THAT(refusal(k_head + points + "radii = [1, 1, 1]\n"), HasSubstr("give the outline once"));
    EXPECT_THAT(refusal(k_head + "unit = \"inch\"\n" + points), HasSubstr("it.toml:3:8: unit: \"inch\" is none of"));
    EXPECT_THAT(refusal(k_head + "points = [[0, 0], [1, 0]]\n"), HasSubstr("it.toml:3:10: points: give at least 3"));
    EXPECT_THAT(refusal(k_head + "points = [[0, 0],\n[1],\n[0, 1]]\n"),
                HasSubstr("it.toml:4:1: points: give each point as [x, y]"));
    EXPECT_THAT(refusal(k_head + "points = [[0, 0], [1, \"a\"], [0, 1]]\n"),
                HasSubstr("it.toml:3:23: points must be a number"));
    EXPECT_THAT(refusal(k_head + "points = [[0, 0], [1, nan], [0, 1]]\n"),
                HasSubstr("it.toml:3:23: points must be a number"));
    EXPECT_THAT(refusal(k_head + "radii = [1, 1, -1]\n"), HasSubstr("it.toml:3:16: the radius -1 must be above 0"));
    EXPECT_THAT(refusal(k_head + "polar = [[1, 0], [0, 90], [1, 200]]\n"), HasSubstr("the radius 0 must be above 0"));
    EXPECT_THROW((void)read_outline_file(folder_ / "absent.toml"), InputError);
    EXPECT_THROW((void)read_outline_file(folder_), InputError);
}

// shapes/draw_outlines.py is what the sources of the outlines speak of; it must give the files that are shipped.
TEST_F(OutlineFiles, OfTheLibraryAreThoseThatTheScriptDraws) {
    const std::string command = fmt::format("python3 shapes/draw_outlines.py {}", folder_.string());
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    for (const OutlineFile& outline : shape_library()) {
        SCOPED_TRACE(outline.name);
        const OutlineFile drawn = read_outline_file(folder_ / (outline.name + ".toml"));
        EXPECT_EQ(drawn.title, outline.title);
        EXPECT_EQ(drawn.source, outline.source);
        ASSERT_EQ(drawn.points.size(), outline.points.size());
        for (std::size_t k = 0; k < drawn.points.size(); ++k) {
            // The last decimal may round the other way where the C library differs.
            EXPECT_NEAR((drawn.points[k] - outline.points[k]).norm(), 0.0, 1.5e-7) << k;
        }
    }
}

}  // namespace
}  // namespace polargrain
