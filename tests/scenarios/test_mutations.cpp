#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <iterator>

#include "src/core/random.h"
#include "tests/scenarios/scenario_text.h"

namespace polargrain::testing {
namespace {

/// Words, numbers, quotes, brackets: what a slip of the pen puts in the wrong place.
std::vector<std::string> tokens_of(const std::string& text) {
    std::vector<std::string> tokens;
    bool in_word = false;
    for (const char c : text) {
        const bool word = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
        if (word && in_word) {
            tokens.back() += c;
        } else {
            tokens.emplace_back(1, c);
        }
        in_word = word;
    }
    return tokens;
}

std::string joined(const std::vector<std::string>& tokens) {
    std::string text;
    for (const std::string& token : tokens) text += token;
    return text;
}

std::size_t below(RandomStream& random, std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

/// Deletes, doubles, swaps or replaces a few tokens.
std::string mutated(std::vector<std::string> tokens, RandomStream& random) {
    static const std::vector<std::string> odd = {
        "-1", "0", "1e308", "nan", "inf", "[]", "{}", "\"\"", "true", "1e-300", "99999999999999999999", "\xff"};
    for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
        const std::size_t at = below(random, tokens.size());
        switch (below(random, 5)) {
            case 0: tokens[at].clear(); break;
            case 1: tokens[at] += tokens[at]; break;
            case 2: std::swap(tokens[at], tokens[below(random, tokens.size())]); break;
            case 3: tokens[at] = tokens[below(random, tokens.size())]; break;
            default: tokens[at] = odd[below(random, odd.size())]; break;
        }
    }
    return joined(tokens);
}

TEST(Mutations, OfShippedScenariosAreTakenOrRefusedAndNothingElse) {
    constexpr std::uint64_t k_seed = 20;
    constexpr int k_per_scenario = 150;
    int taken = 0, refused = 0;
    std::uint64_t number = 0;
    for (const ScenarioEntry& entry : shipped_scenarios()) {
        std::ifstream file(entry.path);
        const std::vector<std::string> tokens =
            tokens_of({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
        ++number;
        for (int k = 0; k < k_per_scenario; ++k) {
            RandomStream random(k_seed, RandomPurpose::test, number, static_cast<std::uint32_t>(k));
            const std::string text = mutated(tokens, random);
            try {
                load_text(text);
                ++taken;
            } catch (const InputError& error) {
                ++refused;
                EXPECT_NE(std::string(error.what()).find("case.toml"), std::string::npos)
                    << error.what() << "\nseed " << k_seed << ", scenario " << entry.name << ", mutation " << k;
            } catch (const std::exception& error) {
                FAIL() << error.what() << "\nseed " << k_seed << ", scenario " << entry.name << ", mutation " << k
                       << "\n"
                       << text;
            }
        }
    }
    // Both must happen, else the mutations are too mild or too wild to prove anything.
    EXPECT_GT(taken, 50) << "seed " << k_seed;
    EXPECT_GT(refused, 50) << "seed " << k_seed;
}

}  // namespace
}  // namespace polargrain::testing
