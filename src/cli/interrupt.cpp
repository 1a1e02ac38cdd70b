#include "src/cli/interrupt.h"

#include <csignal>

namespace polargrain {

namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch a lock-free flag");

}  // namespace

const std::atomic<bool>& watch_interrupts() {
    struct sigaction action = {};
    action.sa_handler = [](int) { interrupted.store(true, std::memory_order_relaxed); };
    sigemptyset(&action.sa_mask);
    // SA_RESTART: a write to a file in progress is not cut short.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return interrupted;
}

}  // namespace polargrain
