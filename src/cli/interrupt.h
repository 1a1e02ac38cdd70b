#pragma once

#include <atomic>

namespace polargrain {

/// Turns SIGINT (Ctrl-C) and SIGTERM into a flag, once: a second signal ends the program at once, as it would without.
/// Returns the flag, which lives as long as the program.
const std::atomic<bool>& watch_interrupts();

}  // namespace polargrain
