#define POLARGRAIN_LANES lanes_baseline
#include "src/engines/contact/lane_kernels_body.h"

namespace polargrain {

const LaneKernels lanes_baseline::k_kernels{lanes_baseline::sweep, lanes_baseline::move, "baseline"};

}  // namespace polargrain
