#define POLARGRAIN_OUTLINE outline_baseline
#include "src/detect/outline_kernels_body.h"

namespace polargrain {

const OutlineKernels outline_baseline::k_kernels{outline_baseline::reach, outline_baseline::beyond, "baseline"};

}  // namespace polargrain
