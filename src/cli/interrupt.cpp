#include "src/cli/interrupt.h"

#include <csignal>

namespace polargrain {

namespace {

std::atomic<bool> interrupted = false;
std::atomic<int> received = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may only touch lock-free flags");

}  // namespace

const std::atomic<bool>& watch_interrupts() {
    struct sigaction action = {};
    action.sa_handler = [](int signal) {
        received.store(signal, std::memory_order_relaxed);
        interrupted.store(true, std::memory_order_relaxed);
    };
    sigemptyset(&action.sa_mask);
    // SA_RESTART: a write to a file in progress is not cut short.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before = {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
    return interrupted;
}

int signal_for_children() { return received.load() == SIGINT ? SIGTERM : SIGINT; }

}  // namespace polargrain
