#pragma once

namespace polargrain {

/// Of the same kernels, compiled for three instruction sets, those that this processor runs fastest; the first where
/// the program is built without POLARGRAIN_SIMD.
template <typename Kernels>
const Kernels& fastest_of(const Kernels& baseline, [[maybe_unused]] const Kernels& avx2,
                          [[maybe_unused]] const Kernels& avx512) {
#ifdef POLARGRAIN_SIMD
    if (__builtin_cpu_supports("avx512f")) return avx512;
    if (__builtin_cpu_supports("avx2")) return avx2;
#endif
    return baseline;
}

}  // namespace polargrain
