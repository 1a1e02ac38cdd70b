#pragma once

#include <cstddef>
#include <cstdint>

namespace polargrain {

/// Vertices that a kernel works on at a time.
inline constexpr std::ptrdiff_t k_vertices_at_once = 8;

/// Loops over the vertices of an outline, compiled for several instruction sets. All give the same bits: products and
/// sums are rounded one by one, and the largest of numbers does not depend on their order.
///
/// x, y: coordinates of `count` vertices [m]; dx, dy: a unit direction in their frame.
struct OutlineKernels {
    /// Largest station x dx + y dy of any vertex, at least 0 [m].
    double (*reach)(const double* x, const double* y, std::ptrdiff_t count, double dx, double dy);

    /// Which of up to 64 vertices have a station above the limit [m]: a bit each, the first vertex the lowest.
    std::uint64_t (*beyond)(const double* x, const double* y, std::ptrdiff_t count, double dx, double dy, double limit);

    const char* instruction_set;
};

/// The fastest that this processor can run.
const OutlineKernels& outline_kernels();

namespace outline_baseline {
extern const OutlineKernels k_kernels;
}
namespace outline_avx2 {
extern const OutlineKernels k_kernels;
}
namespace outline_avx512 {
extern const OutlineKernels k_kernels;
}

}  // namespace polargrain
