#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "src/core/trial.h"

namespace polargrain {
namespace {

TEST(Trial, TellsHowTheJobEndedAndLeavesThisProgramAsItWas) {
    int touched = 0;
    EXPECT_EQ(try_out([&] { touched = 1; }, 10), Trial::passed);
    EXPECT_EQ(touched, 0) << "it was done in a copy";
    EXPECT_EQ(try_out([] { throw std::runtime_error("as it will again"); }, 10), Trial::passed);
    EXPECT_EQ(try_out([] { raise(SIGSEGV); }, 10), Trial::crashed);
    EXPECT_EQ(try_out([] { std::abort(); }, 10), Trial::crashed);
    const auto never_ends = [] {
        for (const volatile bool go_on = true; go_on;) {
        }
    };
    EXPECT_EQ(try_out(never_ends, 1), Trial::too_long);
}

}  // namespace
}  // namespace polargrain
