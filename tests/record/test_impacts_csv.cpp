#include <gtest/gtest.h>

#include <charconv>
#include <map>

#include "src/record/impacts_csv.h"
#include "tests/record/small_scene.h"

namespace polargrain {
namespace {

using testing::csv_rows;
using testing::small_scene;
using testing::TemporaryFolder;

/// Grain 2 hits grain 0, central and without friction: the closing speed 1/3 m/s is reversed times e.
ImpactRecord central_impact(const Scene& scene) {
    ImpactRecord impact;
    impact.time = 0.1 + 0.2;  // needs its 17th digit
    impact.step = 300;
    impact.i = 2;
    impact.j = 0;
    impact.centre_i = {0.08, 0.02};
    impact.centre_j = {0.02, 0.02};
    impact.point = {0.03, 0.02};
    impact.normal = Vec2::UnitX();
    impact.restitution = 0.7;
    impact.friction = 0.0;
    impact.mode = SlipMode::sliding;
    impact.i_before = {{-1.0 / 3.0, 0.1}, 0.0};
    impact.j_before = {{0.0, 0.1}, 2.0};
    const double inverse = 1.0 / scene.grains.mass[2] + 1.0 / scene.grains.mass[0];
    impact.impulse_normal = 1.7 / 3.0 / inverse;
    impact.closing_before = -1.0 / 3.0;
    impact.closing_after = 0.7 / 3.0;
    impact.sliding_before = impact.sliding_after = 0.02;
    impact.i_after = impact.i_before;
    impact.i_after.velocity.x() += impact.impulse_normal / scene.grains.mass[2];
    impact.j_after = impact.j_before;
    impact.j_after.velocity.x() -= impact.impulse_normal / scene.grains.mass[0];
    return impact;
}

class ImpactsFile : public ::testing::Test {
protected:
    ImpactsFile() : folder_("impacts"), scene_(small_scene()) {
        ImpactRecord against_wall = central_impact(scene_);
        against_wall.j = wall_body(1);
        StepReport report;
        report.clear(scene_.walls.size());
        report.impact_records = {central_impact(scene_), against_wall};
        ImpactsCsv impacts(folder_ / "impacts.csv", 0.1);
        impacts.begin(scene_, testing::run_info());
        impacts.step(initial_world(scene_), 0.001, report);
        impacts.end();
        rows_ = csv_rows(folder_ / "impacts.csv");
        for (std::size_t c = 0; c < rows_.at(1).size(); ++c) field_[rows_[0].at(c)] = rows_[1][c];
    }

    double number(const std::string& column) const {
        double value = 0.0;
        const std::string& text = field_.at(column);
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    }

    TemporaryFolder folder_;
    Scene scene_;
    std::vector<std::vector<std::string>> rows_;
    std::map<std::string, std::string> field_;
};

TEST_F(ImpactsFile, ColumnsStandInTheOrderOfTheContract) {
    std::string header;
    for (const std::string& column : rows_[0]) header += column + ' ';
    EXPECT_EQ(header,
              "time step i j px py nx ny x_i y_i x_j y_j e mu mode impulse_n impulse_t closing_before closing_after "
              "sliding_before sliding_after vx_i vy_i w_i vx_j vy_j w_j vx_i_after vy_i_after w_i_after vx_j_after "
              "vy_j_after w_j_after ");
    ASSERT_EQ(rows_.size(), 3u);
    EXPECT_EQ(rows_[1].size(), rows_[0].size());
}

TEST_F(ImpactsFile, ARowIsEnoughToComputeTheImpactAgain) {
    const double m_i = scene_.grains.mass[2], m_j = scene_.grains.mass[0];
    const Vec2 n(number("nx"), number("ny"));
    const Vec2 v_i(number("vx_i"), number("vy_i")), v_j(number("vx_j"), number("vy_j"));
    const double closing = (v_i - v_j).dot(n);  // central: the arms do not matter along n
    EXPECT_EQ(closing, number("closing_before"));
    const double impulse = -(1.0 + number("e")) * closing / (1.0 / m_i + 1.0 / m_j);
    EXPECT_NEAR(number("impulse_n"), impulse, 1e-15 * impulse);
    EXPECT_NEAR(number("vx_i_after"), v_i.x() + impulse / m_i * n.x(), 1e-15);
    EXPECT_NEAR(number("vx_j_after"), v_j.x() - impulse / m_j * n.x(), 1e-15);
}

TEST_F(ImpactsFile, NumbersReadBackToTheSameBits) {
    EXPECT_EQ(number("time"), 0.1 + 0.2);
    EXPECT_EQ(field_.at("time"), "0.30000000000000004");
    EXPECT_EQ(number("vx_i"), -1.0 / 3.0);
    EXPECT_EQ(number("vx_j_after"), central_impact(scene_).j_after.velocity.x());
}

TEST_F(ImpactsFile, AWallIsNamedWhereAGrainHasItsNumber) {
    EXPECT_EQ(rows_[1][3], "0");
    EXPECT_EQ(rows_[2][2], "2");
    EXPECT_EQ(rows_[2][3], "shaker");
    EXPECT_EQ(field_.at("mode"), to_string(SlipMode::sliding));
}

}  // namespace
}  // namespace polargrain
