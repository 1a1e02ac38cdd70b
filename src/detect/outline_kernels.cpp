#include "src/detect/outline_kernels.h"

namespace polargrain {

const OutlineKernels& outline_kernels() {
#ifdef POLARGRAIN_SIMD
    static const OutlineKernels& fastest = __builtin_cpu_supports("avx512f") ? outline_avx512::k_kernels
                                           : __builtin_cpu_supports("avx2")  ? outline_avx2::k_kernels
                                                                             : outline_baseline::k_kernels;
    return fastest;
#else
    return outline_baseline::k_kernels;
#endif
}

}  // namespace polargrain
