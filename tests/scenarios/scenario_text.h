#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "scenarios/reader.h"
#include "src/core/error.h"

namespace polargrain::testing {

/// A scenario file that lives as long as the test.
class ScenarioFile {
public:
    explicit ScenarioFile(const std::string& text, const std::string& name = "case.toml") {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        std::string unique = std::string(test->test_suite_name()) + "." + test->name();
        for (char& c : unique) c = c == '/' ? '_' : c;
        folder_ = std::filesystem::temp_directory_path() / ("polargrain-" + unique + "-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
        path_ = folder_ / name;
        std::ofstream(path_) << text;
    }
    ScenarioFile(const ScenarioFile&) = delete;
    ScenarioFile& operator=(const ScenarioFile&) = delete;
    ~ScenarioFile() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }
    const std::filesystem::path& folder() const { return folder_; }

private:
    std::filesystem::path folder_, path_;
};

inline Scenario load_text(const std::string& text, const ScenarioOverrides& overrides = {}) {
    return load_scenario(ScenarioFile(text).path(), overrides);
}

/// What the reader says against a text, with the file's name shortened to "case.toml"; empty where it takes it.
inline std::string complaint(const std::string& text, const ScenarioOverrides& overrides = {}) {
    const ScenarioFile file(text);
    try {
        load_scenario(file.path(), overrides);
    } catch (const InputError& error) {
        std::string message = error.what();
        const std::string folder = file.folder().string() + "/";
        for (std::size_t at = 0; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
        return message;
    }
    return "";
}

/// A floor and a disk 1 m above it.
inline const std::string& small_scenario() {
    static const std::string text = R"(title = "small"
[run]
duration = 2.0
[materials.rubber]
density = 1100.0
restitution = 0.8
friction = 0.5
[shapes.ball]
type = "disk"
radius = 0.05
[shapes.bar]
type = "rectangle"
width = 0.2
height = 0.1
[[walls]]
name = "floor"
material = "rubber"
points = [[-1.0, 0.0], [1.0, 0.0]]
[[grains]]
shape = "ball"
material = "rubber"
position = [0.0, 1.0]
)";
    return text;
}

/// The text with its first `from` replaced; fails the test where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "no \"" << from << "\" to replace";
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return text;
}

}  // namespace polargrain::testing
