#include "src/core/build_info.h"

namespace polargrain {

const BuildInfo& build_info() {
    static const BuildInfo info{POLARGRAIN_VERSION, POLARGRAIN_COMPILER, POLARGRAIN_FLAGS, POLARGRAIN_LIBRARIES};
    return info;
}

}  // namespace polargrain
