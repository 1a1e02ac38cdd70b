#include "src/detect/outline_kernels.h"

#include "src/core/instruction_set.h"

namespace polargrain {

const OutlineKernels& outline_kernels() {
    static const OutlineKernels& fastest =
        fastest_of(outline_baseline::k_kernels, outline_avx2::k_kernels, outline_avx512::k_kernels);
    return fastest;
}

}  // namespace polargrain
