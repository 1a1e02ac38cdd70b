#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/build_info.h"
#include "src/core/error.h"

namespace polargrain {
namespace {

using testing::HasSubstr;

TEST(SourceLocation, LeavesOutWhatIsUnknown) {
    EXPECT_EQ(to_string({"a.toml", 3, 7}), "a.toml:3:7");
    EXPECT_EQ(to_string({"a.toml", 3, 0}), "a.toml:3");
    EXPECT_EQ(to_string({"a.toml", 0, 7}), "a.toml");
}

TEST(InputError, PutsThePlaceInFront) {
    EXPECT_STREQ(InputError({"a.toml", 3, 7}, "too small").what(), "a.toml:3:7: too small");
    EXPECT_STREQ(InputError(SourceLocation{}, "too small").what(), "too small");
}

TEST(Require, ThrowsWithTheValuesOnlyWhereTheConditionFails) {
    EXPECT_NO_THROW(require(true, "radius {}", 1.0));
    try {
        require(false, "radius {} of {}", -1.0, "disk");
        FAIL() << "nothing was thrown";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "radius -1 of disk");
    }
}

TEST(BrokenInvariant, NamesExpressionPlaceAndValues) {
    try {
        broken_invariant("a < b", "file.cpp", 12, "a 2 b 1");
    } catch (const std::logic_error& error) {
        EXPECT_STREQ(error.what(), "file.cpp:12: broken invariant: a < b (a 2 b 1)");
    }
}

TEST(BuildInfo, TellsVersionCompilerFlagsAndLibraries) {
    EXPECT_THAT(build_info().version, testing::MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
    EXPECT_THAT(build_info().flags, HasSubstr("-ffp-contract=off"));
    EXPECT_THAT(build_info().libraries, HasSubstr("CGAL 5"));
    EXPECT_THAT(build_info().compiler, testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace polargrain
