#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "src/reproduce/dominoes.h"
#include "src/reproduce/efficiency_ladder.h"
#include "src/reproduce/efficiency_scenes.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RungResult rung(double cost, double error) { return {"", cost, 0.0, 0.0, error, 0.0}; }

TEST(ConvergedValue, IsTheMeanOfTheMethodsAndAsUncertainAsTheyDiffer) {
    const ConvergedValue c = converged_value({{"", {9.9, 10.1}, {}}, {"", {10.9, 11.1}, {}}});
    EXPECT_DOUBLE_EQ(c.value, 10.5);
    EXPECT_DOUBLE_EQ(c.uncertainty, 0.5);
}

TEST(ConvergedValue, IsAsUncertainAsItsScatterWhereTheMethodsAgree) {
    const ConvergedValue c = converged_value({{"", {8.0, 12.0}, {}}, {"", {9.0, 11.0}, {}}});
    // Standard errors 2 and 1, of the mean of both sqrt(2^2 + 1^2) / 2.
    EXPECT_DOUBLE_EQ(c.value, 10.0);
    EXPECT_DOUBLE_EQ(c.uncertainty, std::sqrt(5.0) / 2.0);
    EXPECT_TRUE(std::isnan(converged_value({}).value));
}

TEST(RungResult, ErrorsAreRelativeAndRunsWithoutAValueAreLeftOut) {
    const RungResult r = rung_result({"half", {9.0, std::nan(""), 11.0}, {1.0, 2.0, 3.0}}, {8.0, 0.1});
    EXPECT_EQ(r.label, "half");
    EXPECT_DOUBLE_EQ(r.cost, 2.0);
    EXPECT_DOUBLE_EQ(r.value, 10.0);
    EXPECT_DOUBLE_EQ(r.error, 0.25);
    EXPECT_DOUBLE_EQ(r.uncertainty, 1.0 / 8.0);
    EXPECT_TRUE(std::isnan(rung_result({"", {std::nan("")}, {1.0}}, {8.0, 0.1}).error));
}

TEST(CheapestRight, IsTheCoarsestThatStaysRight) {
    EXPECT_EQ(cheapest_right({rung(1, 0.3), rung(2, 0.04), rung(4, 0.02)}, 0.05)->cost, 2.0);
    EXPECT_EQ(cheapest_right({rung(1, 0.01), rung(2, 0.10), rung(4, 0.02)}, 0.05)->cost, 4.0)
        << "right by chance does not count";
    EXPECT_FALSE(cheapest_right({rung(1, 0.01), rung(2, 0.10)}, 0.05)) << "the finest is not right";
    EXPECT_FALSE(cheapest_right({rung(1, 0.01), rung(2, std::nan(""))}, 0.05));
    EXPECT_FALSE(cheapest_right({}, 0.05));
}

TEST(CheapestRight, TakesAFinerStepWhereThatCostsLess) {
    EXPECT_EQ(cheapest_right({rung(3, 0.02), rung(2, 0.02), rung(4, 0.02)}, 0.05)->cost, 2.0);
}

TEST(EfficiencyPieces, AreAllDifferentAndOfTheEnginesAtHand) {
    std::size_t rungs = 0;
    for (const EfficiencyScene& scene : efficiency_scenes()) {
        rungs += scene.beginnings * efficiency_ladder(scene, "contact").size();
        rungs += scene.beginnings * efficiency_ladder(scene, "dem").size();
    }
    const std::vector<Piece> pieces = efficiency_pieces({"contact", "dem"});
    std::set<std::string> scenarios;
    for (const Piece& piece : pieces) scenarios.insert(piece.scenario);
    EXPECT_EQ(pieces.size(), rungs);
    EXPECT_EQ(scenarios.size(), rungs);
}

TEST(DominoPieces, CarryTheTablesOfTheirSetup) {
    DominoSetup setup{.kind = table_1().front(), .gap = 2.0, .table_friction = 1.5, .engine = "dem"};
    EXPECT_THAT(domino_piece(setup).scenario, Not(HasSubstr("[dem]")));
    setup.tables = "\n[dem]\nresolution = 12\n";
    setup.count = 7;
    EXPECT_THAT(domino_piece(setup).scenario, HasSubstr("resolution = 12"));
    EXPECT_THAT(domino_piece(setup).scenario, HasSubstr("count = 7"));
}

}  // namespace
}  // namespace polargrain
