#define POLARGRAIN_LANES lanes_avx2
#include "src/engines/contact/lane_kernels_body.h"

namespace polargrain {

const LaneKernels lanes_avx2::k_kernels{lanes_avx2::sweep, lanes_avx2::move, "avx2"};

}  // namespace polargrain
