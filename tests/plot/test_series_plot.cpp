#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "src/core/error.h"
#include "src/plot/series_plot.h"

namespace polargrain {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class SeriesPlots : public ::testing::Test {
protected:
    void SetUp() override {
        std::ofstream(csv_)
            << "time,step,kinetic_translational,kinetic_rotational,potential,moves_rejected,moves_tried,"
               "wall_the_floor_fx,wall_the_floor_fy,wall_the_floor_torque,height of the bed\n"
               "0,0,1,0.5,9,0,3,0,0,0,nan\n"
               "0.1,1,2,0.25,8,0,6,0,-4,-2,0.7\n"
               "0.2,2,3,0,7,0,9,0,-5,-3,0.6\n"
               "0.3,3,4";  // a run in progress
    }
    void TearDown() override { std::filesystem::remove(csv_); }

    SeriesPlot drawn(const SeriesChoice& choice = {}) const { return series_plot(csv_, choice, "a run"); }
    static std::vector<std::string> titles(const SeriesPlot& drawn) {
        std::vector<std::string> titles;
        for (const Panel& panel : drawn.plot.panels) titles.push_back(panel.title);
        return titles;
    }

    std::filesystem::path csv_ =
        std::filesystem::path(::testing::TempDir()) /
        (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + "-series.csv");
};

TEST_F(SeriesPlots, HaveAPanelForWhatBelongsTogether) {
    const SeriesPlot all = drawn();
    EXPECT_THAT(titles(all), ElementsAre("kinetic energy", "potential energy", "force on the wall the_floor",
                                         "torque on the wall the_floor", "height of the bed"));
    const Panel& kinetic = all.plot.panels[0];
    ASSERT_EQ(kinetic.series.size(), 2);
    EXPECT_EQ(kinetic.series[1].label, "kinetic_rotational");
    EXPECT_THAT(kinetic.series[1].x, ElementsAre(0.0, 0.1, 0.2)) << "a row cut short does not count";
    EXPECT_THAT(kinetic.series[1].y, ElementsAre(0.5, 0.25, 0.0));
    EXPECT_EQ(kinetic.y_label, "[J/m]");
    EXPECT_EQ(all.plot.panels[3].y_label, "[N]");
}

TEST_F(SeriesPlots, LeaveOutWhatIsZeroThroughoutAndSaySo) {
    const SeriesPlot all = drawn();
    EXPECT_THAT(all.left_out, ElementsAre("moves_rejected", "wall_the_floor_fx"));
    ASSERT_EQ(all.plot.panels[2].series.size(), 1);
    EXPECT_EQ(all.plot.panels[2].series[0].label, "wall_the_floor_fy");
}

TEST_F(SeriesPlots, ShowTheColumnsAndTheTimeAskedFor) {
    const SeriesPlot some = drawn({{"height of the bed", "moves_rejected"}, 0.05, 0.15});
    EXPECT_THAT(titles(some), ElementsAre("height of the bed", "moves_rejected"));
    EXPECT_THAT(some.left_out, IsEmpty()) << "what is asked for is drawn, zero or not";
    EXPECT_THAT(some.plot.panels[0].series[0].y, ElementsAre(0.7));
}

TEST_F(SeriesPlots, RefuseWhatTheyCannotShow) {
    EXPECT_THAT([&] { drawn({.columns = {"potentiel"}}); },
                ThrowsMessage<InputError>(HasSubstr("has no column potentiel; did you mean \"potential\"?")));
    EXPECT_THAT(
        [&] {
            drawn({{}, 1.0, 2.0});
        },
        ThrowsMessage<InputError>(HasSubstr("has no row from 1 to 2 s; it has 0 to 0.2 s")));
    EXPECT_THAT([&] { drawn({.columns = {}, .from = 1.0}); },
                ThrowsMessage<InputError>(HasSubstr("has no row from 1 to inf s; it has 0 to 0.2 s")));
    EXPECT_THAT([&] { drawn({{}, 0.2, 0.1}); }, ThrowsMessage<InputError>(HasSubstr("has no row from 0.2 to 0.1 s")));
    std::ofstream(csv_) << "a,b\n1,2\n";
    EXPECT_THAT([&] { drawn(); }, ThrowsMessage<InputError>(HasSubstr("has no column time")));
    std::ofstream(csv_) << "time,impacts\n0,0\n";
    EXPECT_THAT([&] { drawn(); }, ThrowsMessage<InputError>(HasSubstr("nothing to draw")));
}

}  // namespace
}  // namespace polargrain
