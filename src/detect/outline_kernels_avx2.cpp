#define POLARGRAIN_OUTLINE outline_avx2
#include "src/detect/outline_kernels_body.h"

namespace polargrain {

const OutlineKernels outline_avx2::k_kernels{outline_avx2::reach, outline_avx2::beyond, "avx2"};

}  // namespace polargrain
