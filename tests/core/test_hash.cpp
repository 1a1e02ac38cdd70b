#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/core/hash.h"

namespace polargrain {
namespace {

std::string hash_of(const std::vector<double>& values) {
    StateHash hash;
    hash.add(values);
    return hash.hex();
}

TEST(StateHash, SeesTheLastBitOfANumber) {
    EXPECT_EQ(hash_of({1.0, 2.0}), hash_of({1.0, 2.0}));
    EXPECT_NE(hash_of({1.0, 2.0}), hash_of({1.0, std::nextafter(2.0, 3.0)}));
    EXPECT_NE(hash_of({0.0}), hash_of({-0.0})) << "bits count, not values";
}

TEST(StateHash, SeesTheOrder) { EXPECT_NE(hash_of({1.0, 2.0}), hash_of({2.0, 1.0})); }

TEST(StateHash, ChainsWhatIsAdded) {
    StateHash one, other;
    one.add(std::int64_t{1});
    one.add(std::vector{3.0});
    other.add(std::int64_t{2});
    other.add(std::vector{3.0});
    EXPECT_NE(one.value(), other.value());
}

TEST(StateHash, PrintsSixteenHexadecimalDigits) {
    EXPECT_THAT(hash_of({1.0}), testing::MatchesRegex("[0-9a-f]{16}"));
    EXPECT_EQ(StateHash().hex(), "0000000000000000") << "leading zeros stay";
}

TEST(TextHash, IsTheSameIntoWhateverPiecesTheTextIsCut) {
    const std::string text(1000, 'x');
    TextHash whole, cut;
    whole.add(text);
    for (std::size_t at = 0; at < text.size(); at += 7) cut.add(std::string_view(text).substr(at, 7));
    EXPECT_EQ(whole.value(), cut.value());
    cut.add("y");
    EXPECT_NE(whole.value(), cut.value());
}

}  // namespace
}  // namespace polargrain
