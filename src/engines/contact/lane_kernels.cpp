#include "src/engines/contact/lane_kernels.h"

#include "src/core/instruction_set.h"

namespace polargrain {

const LaneKernels& lane_kernels() {
    static const LaneKernels& fastest =
        fastest_of(lanes_baseline::k_kernels, lanes_avx2::k_kernels, lanes_avx512::k_kernels);
    return fastest;
}

}  // namespace polargrain
