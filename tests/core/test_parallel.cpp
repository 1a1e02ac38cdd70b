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

TEST(Parallel, SumsInTheSameOrderOnAnyNumberOfThreads) {
    const auto harmonic = [](const Parallel& parallel) {
        return parallel.sum(100003, 256, [](std::size_t first, std::size_t last) {
            double sum = 0.0;
            for (std::size_t k = first; k < last; ++k) sum += 1.0 / static_cast<double>(k + 1);
            return sum;
        });
    };
    const double sum = harmonic(Parallel(1));
    EXPECT_NEAR(sum, 12.090176129263442, 1e-12);
    for (const int threads : {2, 5}) EXPECT_EQ(harmonic(Parallel(threads)), sum) << threads << " threads";
    EXPECT_EQ(Parallel(2).sum(0, 8, [](std::size_t, std::size_t) { return 1; }), 0);
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
