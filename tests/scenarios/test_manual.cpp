#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "scenarios/reader.h"
#include "tests/scenarios/scenario_text.h"

namespace polargrain::testing {
namespace {

std::string manual() {
    std::ifstream file(std::string(POLARGRAIN_SOURCE_DIR) + "/docs/scenario.md");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Section of the manual under the header that begins with the table's name: "## [run]", "## [[walls]]".
std::string section(const std::string& text, const std::string& table) {
    for (const std::string open : {"\n## [", "\n## [["}) {
        for (const std::string close : {"]", ".NAME]"}) {
            const std::size_t start = text.find(open + table + close);
            if (start == std::string::npos) continue;
            const std::size_t end = text.find("\n## ", start + 1);
            return text.substr(start, end == std::string::npos ? end : end - start);
        }
    }
    return "";
}

TEST(Manual, HasEveryKeyInTheSectionOfItsTable) {
    const std::string text = manual();
    ASSERT_FALSE(text.empty());
    const std::vector<std::string> keys = known_scenario_keys();
    EXPECT_GT(keys.size(), 100U);
    for (const std::string& key : keys) {
        const std::size_t first = key.find('.');
        const std::string last = key.substr(key.rfind('.') + 1);
        const std::string part = first == std::string::npos
                                     ? section("\n" + text, "run") + text.substr(0, text.find("## [run]"))
                                     : section(text, key.substr(0, first));
        ASSERT_FALSE(part.empty()) << "docs/scenario.md has no section for " << key;
        const std::string parent = key.substr(first + 1, key.find('.', first + 1) - first - 1);
        const bool listed = part.find("`" + last + "`") != std::string::npos ||
                            part.find("`" + last + ".") != std::string::npos ||
                            part.find("`" + parent + "." + last + "`") != std::string::npos;
        EXPECT_TRUE(listed) << "docs/scenario.md does not explain " << key;
    }
}

TEST(Manual, ExampleRuns) {
    const std::string text = manual();
    const std::size_t start = text.find("```toml\n") + 8;
    EXPECT_EQ(complaint(text.substr(start, text.find("```", start) - start)), "");
}

}  // namespace
}  // namespace polargrain::testing
