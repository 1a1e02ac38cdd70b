#include "src/engines/contact/lane_kernels.h"

namespace polargrain {

const LaneKernels& lane_kernels() {
#ifdef POLARGRAIN_SIMD
    static const LaneKernels& fastest = __builtin_cpu_supports("avx512f") ? lanes_avx512::kernels
                                        : __builtin_cpu_supports("avx2")  ? lanes_avx2::kernels
                                                                          : lanes_baseline::kernels;
    return fastest;
#else
    return lanes_baseline::kernels;
#endif
}

}  // namespace polargrain
