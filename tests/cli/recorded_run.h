#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "tests/cli/program_runner.h"
#include "tests/cli/small_scenarios.h"

namespace polargrain {

/// A folder of its own with the run of a scenario in `run`, for commands that work on runs.
class RecordedRun : public testing::Test {
protected:
    explicit RecordedRun(const std::string& scenario) {
        scratch_.write("three.toml", scenario);
        EXPECT_EQ(polargrain({"run", "three.toml", "-o", "run"}).exit_code, 0);
    }
    Outcome polargrain(const std::vector<std::string>& arguments) const {
        return run_polargrain(arguments, scratch_.path());
    }
    std::ptrdiff_t files_in(const std::string& folder) const {
        return std::distance(std::filesystem::directory_iterator(scratch_ / folder), {});
    }
    ScratchFolder scratch_;
};

}  // namespace polargrain
