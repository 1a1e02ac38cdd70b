#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "src/core/parallel.h"

namespace polargrain {
namespace {

TEST(Parallel, RunsEveryPieceOnce) {
    for (const int threads : {1, 2, 5}) {
        const Parallel parallel(threads);
        std::vector<int> runs(1000, 0);
        for (int k = 0; k < 20; ++k) parallel.each(runs.size(), [&](std::size_t piece) { ++runs[piece]; });
        EXPECT_EQ(runs, std::vector<int>(1000, 20)) << threads << " threads";
        parallel.each(0, [](std::size_t) { FAIL() << "there is nothing to do"; });
    }
}

TEST(Parallel, PassesAnExceptionOn) {
    for (const int threads : {1, 3}) {
        const Parallel parallel(threads);
        const auto fails = [](std::size_t piece) {
            if (piece == 7) throw std::runtime_error("seven");
        };
        EXPECT_THROW(parallel.each(20, fails), std::runtime_error);
    }
}

}  // namespace
}  // namespace polargrain
