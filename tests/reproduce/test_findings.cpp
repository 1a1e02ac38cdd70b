#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "src/core/error.h"
#include "src/reproduce/figure.h"
#include "src/reproduce/finding.h"
#include "src/reproduce/report.h"
#include "src/reproduce/statistics.h"

namespace polargrain {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Finding finding(double measured, double lowest, double highest, const std::string& engine = "") {
    return {engine, "speed", measured, lowest, highest, "m/s", "theory", "friction"};
}

TEST(Finding, AgreesWithinItsBandAndTellsHowFarOffItIs) {
    EXPECT_EQ(outcome(finding(1.0, 1.0, 2.0)), "agrees");
    EXPECT_EQ(outcome(finding(2.0, 1.0, 2.0)), "agrees");
    EXPECT_EQ(outcome(finding(2.2, 1.0, 2.0)), "differs by +10 %");
    EXPECT_EQ(outcome(finding(0.75, 1.0, 2.0)), "differs by -25 %");
    EXPECT_EQ(outcome(finding(3.0, 0.0, 0.0)), "differs by +3");
    EXPECT_EQ(outcome(finding(std::nan(""), 1.0, 2.0)), "no value");
}

TEST(Verdict, CountsEachEngineApart) {
    EXPECT_EQ(verdict({finding(1.0, 1.0, 1.0), finding(1.5, 1.0, 2.0)}), "agrees (2 of 2)");
    EXPECT_EQ(verdict({finding(1.0, 1.0, 1.0, "a"), finding(9.0, 1.0, 2.0, "a"), finding(9.0, 1.0, 2.0, "b")}),
              "a: agrees in 1 of 2; b: differs (0 of 1)");
    EXPECT_EQ(verdict({}), "nothing to hold it to");
}

TEST(Statistics, LeaveOutWhatIsNoNumber) {
    const MeanSpread m = mean_and_spread({1.0, std::nan(""), 3.0});
    EXPECT_DOUBLE_EQ(m.mean, 2.0);
    EXPECT_DOUBLE_EQ(m.spread, std::sqrt(2.0));
    EXPECT_TRUE(std::isnan(mean_and_spread({}).mean));
    EXPECT_EQ(mean_and_spread({4.0}).spread, 0.0);
}

TEST(Statistics, CountIntoBins) {
    const Series bars = histogram({0.0, 0.4, 1.0, 1.9, 2.0, -1.0}, 0.0, 2.0, 2, "h", 0);
    EXPECT_THAT(bars.x, ElementsAre(0.5, 1.5));
    EXPECT_THAT(bars.y, ElementsAre(2.0, 2.0)) << "2.0 and -1.0 are outside";
}

TEST(Base64, IsThatOfTheStandard) {
    // RFC 4648, section 10.
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

class Folder : public ::testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    std::string read(const std::string& name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    fs::path folder_ = fs::path(::testing::TempDir()) /
                       ("reproduce-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

class Reports : public Folder {};

TEST_F(Reports, StandAloneAndKeepFiguresDrawnEarlier) {
    write("fig7.png", "picture");
    const Report report(folder_);
    FigureResult first;
    first.paragraphs = {"an <angle> & more"};
    first.pictures = {{folder_ / "fig7", "the normals"}};
    first.tables = {{"cases", {"case"}, {{"a < b"}}}};
    first.findings = {finding(9.0, 1.0, 2.0, "contact")};
    report.add(find_figures({"fig7"})[0], first);
    report.write("contact");
    FigureResult second;
    second.findings = {finding(1.0, 1.0, 2.0), finding(std::nan(""), 1.0, 2.0)};
    report.add(find_figures({"fig9"})[0], second);
    report.write("contact");
    const std::string page = read("report.html");
    EXPECT_THAT(page, HasSubstr("an &lt;angle&gt; &amp; more"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,cGljdHVyZQ=="));
    EXPECT_THAT(page, HasSubstr("a &lt; b"));
    EXPECT_THAT(page, HasSubstr("contact: differs (0 of 1)"));
    EXPECT_THAT(page, HasSubstr("(friction)")) << "why it differs";
    EXPECT_THAT(page, HasSubstr("id=\"fig9\""));
    EXPECT_THAT(page, HasSubstr("<td>none</td>")) << "what could not be measured";
    for (const char* outside : {"src=\"http", "<script", "<link", "@import", "url("}) {
        EXPECT_THAT(page, Not(HasSubstr(outside)));
    }
    EXPECT_THAT(read("verdicts.csv"), HasSubstr("fig7,contact,speed,9,1,2,m/s,differs by +350 %,theory,friction\n"));
}

TEST(Figures, AreFoundByTheirNames) {
    EXPECT_EQ(find_figures({}).size(), figures().size());
    const auto two = find_figures({"fig9", "fig2"});
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].id, "fig2") << "in the order of the paper";
    try {
        find_figures({"fig1l"});
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("fig11"));
    }
}

}  // namespace
}  // namespace polargrain
