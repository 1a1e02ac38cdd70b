#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/core/random.h"
#include "src/detect/outline_kernels.h"

namespace polargrain {
namespace {

/// Those that this processor can run.
std::vector<const OutlineKernels*> kernels() {
    std::vector<const OutlineKernels*> all{&outline_baseline::k_kernels};
#ifdef POLARGRAIN_SIMD
    if (__builtin_cpu_supports("avx2")) all.push_back(&outline_avx2::k_kernels);
    if (__builtin_cpu_supports("avx512f")) all.push_back(&outline_avx512::k_kernels);
#endif
    return all;
}

TEST(OutlineKernels, FindReachAndFacingVerticesToTheLastBit) {
    RandomStream random(7, RandomPurpose::test);
    for (int count = 3; count <= 64; ++count) {
        std::vector<double> x, y;
        for (int k = 0; k < count; ++k) {
            x.push_back(random.normal());
            y.push_back(random.normal());
        }
        const double angle = random.uniform(-3.0, 3.0);
        const double dx = std::cos(angle);
        const double dy = std::sin(angle);
        // A limit that is the station of a vertex tells above from at.
        const auto middle = static_cast<std::size_t>(count / 2);
        const double limit = x[middle] * dx + y[middle] * dy;
        double reach = 0.0;
        std::uint64_t beyond = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double station = x[k] * dx + y[k] * dy;
            reach = std::max(reach, station);
            if (station > limit) beyond |= std::uint64_t{1} << k;
        }
        for (const OutlineKernels* set : kernels()) {
            EXPECT_EQ(set->reach(x.data(), y.data(), count, dx, dy), reach) << set->instruction_set << ", " << count;
            EXPECT_EQ(set->beyond(x.data(), y.data(), count, dx, dy, limit), beyond)
                << set->instruction_set << ", " << count;
        }
    }
}

TEST(OutlineKernels, ReachNoLessThanTheCentreOfMass) {
    const std::vector<double> x{1.0, 2.0, 1.5};
    const std::vector<double> y{0.0, 0.1, 0.2};
    for (const OutlineKernels* set : kernels()) EXPECT_EQ(set->reach(x.data(), y.data(), 3, -1.0, 0.0), 0.0);
}

}  // namespace
}  // namespace polargrain
