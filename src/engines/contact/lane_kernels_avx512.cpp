#define POLARGRAIN_LANES lanes_avx512
#include "src/engines/contact/lane_kernels_body.h"

namespace polargrain {

const LaneKernels lanes_avx512::k_kernels{lanes_avx512::sweep, lanes_avx512::move, "avx512"};

}  // namespace polargrain
