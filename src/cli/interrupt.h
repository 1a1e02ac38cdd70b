#pragma once

#include <atomic>

namespace polargrain {

/// Turns SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal is gone) into a flag, each once: the same signal a second
/// time ends the program at once, as it would without. SIGHUP stays ignored where it is, as under nohup. Returns the
/// flag, which lives as long as the program.
const std::atomic<bool>& watch_interrupts();

/// One of these that a program started from here has not been sent along with this one. Ctrl-C reaches all that were
/// started in a terminal, and so does its end: sending them the same signal again would end them at once.
int signal_for_children();

}  // namespace polargrain
