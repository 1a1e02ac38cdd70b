#include "src/engines/contact/lane_kernels.h"

namespace polargrain {

const LaneKernels& lane_kernels() {
#ifdef POLARGRAIN_SIMD
    static const LaneKernels& fastest = __builtin_cpu_supports("avx512f") ? lanes_avx512::k_kernels
                                        : __builtin_cpu_supports("avx2")  ? lanes_avx2::k_kernels
                                                                          : lanes_baseline::k_kernels;
    return fastest;
#else
    return lanes_baseline::k_kernels;
#endif
}

}  // namespace polargrain
