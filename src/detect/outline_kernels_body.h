// Not a header of its own: included once by each source that is compiled for one instruction set, which defines
// POLARGRAIN_OUTLINE, the namespace to put it in. Everything else here has internal linkage, so that no code for a
// better processor can stand in for that of a lesser one.

#include <cstddef>
#include <cstdint>

#include "src/detect/outline_kernels.h"

// Vectors wider than the registers are passed in memory; nothing outside this source ever sees one.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace polargrain::POLARGRAIN_OUTLINE {

namespace {

using Wide = double __attribute__((vector_size(64)));
using Bits = std::int64_t __attribute__((vector_size(64)));

inline Wide load(const double* from) {
    Wide wide;
    __builtin_memcpy(&wide, from, sizeof(wide));
    return wide;
}

inline Wide stations(const double* x, const double* y, double dx, double dy) { return load(x) * dx + load(y) * dy; }

inline double larger(double a, double b) { return a > b ? a : b; }

inline double largest(const Wide& w) {
    return larger(larger(larger(w[0], w[4]), larger(w[1], w[5])), larger(larger(w[2], w[6]), larger(w[3], w[7])));
}

inline std::uint64_t all(const Bits& b) {
    return static_cast<std::uint64_t>(((b[0] | b[4]) | (b[1] | b[5])) | ((b[2] | b[6]) | (b[3] | b[7])));
}

}  // namespace

// Eight vertices at a time. The last eight may hold some that have had their turn, which does no harm.

static double reach(const double* x, const double* y, std::ptrdiff_t count, double dx, double dy) {
    double most = 0.0;
    if (count < k_vertices_at_once) {
        for (std::ptrdiff_t k = 0; k < count; ++k) most = larger(x[k] * dx + y[k] * dy, most);
        return most;
    }
    Wide wide = stations(x + count - k_vertices_at_once, y + count - k_vertices_at_once, dx, dy);
    for (std::ptrdiff_t k = 0; k + k_vertices_at_once < count; k += k_vertices_at_once) {
        const Wide next = stations(x + k, y + k, dx, dy);
        wide = next > wide ? next : wide;
    }
    return larger(largest(wide), most);
}

static std::uint64_t beyond(const double* x, const double* y, std::ptrdiff_t count, double dx, double dy,
                            double limit) {
    if (count < k_vertices_at_once) {
        std::uint64_t mask = 0;
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            mask |= static_cast<std::uint64_t>(x[k] * dx + y[k] * dy > limit) << k;
        }
        return mask;
    }
    constexpr Bits k_bit = {1, 2, 4, 8, 16, 32, 64, 128};
    Bits bits = (stations(x + count - k_vertices_at_once, y + count - k_vertices_at_once, dx, dy) > limit) &
                (k_bit << (count - k_vertices_at_once));
    for (std::ptrdiff_t k = 0; k + k_vertices_at_once < count; k += k_vertices_at_once) {
        bits |= (stations(x + k, y + k, dx, dy) > limit) & (k_bit << k);
    }
    return all(bits);
}

}  // namespace polargrain::POLARGRAIN_OUTLINE
