#define POLARGRAIN_OUTLINE outline_avx512
#include "src/detect/outline_kernels_body.h"

namespace polargrain {

const OutlineKernels outline_avx512::k_kernels{outline_avx512::reach, outline_avx512::beyond, "avx512"};

}  // namespace polargrain
