#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "src/core/error.h"
#include "src/record/csv_columns.h"

namespace polargrain {
namespace {

using ::testing::ElementsAre;

TEST(CsvColumns, GoByTheirNames) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "columns.csv";
    std::ofstream(file) << "time,step,note\n0,1,x\n0.5,2,y\n0.7,3";
    const auto [names, columns] = read_columns(file);
    EXPECT_THAT(names, ElementsAre("time", "step", "note"));
    EXPECT_THAT(columns.at("time"), ElementsAre(0.0, 0.5)) << "a row cut short does not count";
    EXPECT_TRUE(std::isnan(columns.at("note")[0]));
    std::filesystem::remove(file);
    EXPECT_THROW(read_columns(file), InputError);
}

}  // namespace
}  // namespace polargrain
