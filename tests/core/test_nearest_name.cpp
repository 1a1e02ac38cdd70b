#include <gtest/gtest.h>

#include <vector>

#include "src/core/nearest_name.h"

namespace polargrain {
namespace {

const std::vector<std::string> k_keys{"duration", "time_step", "gravity", "incline", "seed", "threads"};

TEST(NearestName, FindsOneSlipOfEachKind) {
    EXPECT_EQ(nearest_name("duratio", k_keys), "duration") << "a letter left out";
    EXPECT_EQ(nearest_name("durattion", k_keys), "duration") << "a letter too many";
    EXPECT_EQ(nearest_name("durasion", k_keys), "duration") << "a wrong letter";
    EXPECT_EQ(nearest_name("druation", k_keys), "duration") << "two letters swapped";
}

TEST(NearestName, TakesTheNearestOfSeveral) { EXPECT_EQ(nearest_name("treads", k_keys), "threads"); }

TEST(NearestName, OffersNothingWhereNothingIsNear) {
    EXPECT_EQ(nearest_name("restitution", k_keys), "");
    EXPECT_EQ(nearest_name("duration", std::vector<std::string>{}), "");
}

TEST(NearestName, TheFirstOfEquallyNearOnes) {
    EXPECT_EQ(nearest_name("cat", std::vector<std::string>{"bat", "hat"}), "bat");
}

}  // namespace
}  // namespace polargrain
