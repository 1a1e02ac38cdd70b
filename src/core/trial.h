#pragma once

#include <functional>

namespace polargrain {

enum class Trial { passed, crashed, too_long };

/// Does a job in a copy of this program that is thrown away afterwards, and tells how that ended: for libraries that a
/// damaged file can make crash or go round in circles. What the job throws counts as passed, as it will again.
///
/// seconds: of processor time that the job may take. The job must not wait for another thread, of which the copy has
/// none. RunError where no copy can be made.
Trial try_out(const std::function<void()>& job, unsigned seconds);

}  // namespace polargrain
