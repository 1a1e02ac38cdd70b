#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

namespace polargrain {

/// How far a loop of steps has come.
struct Progress {
    double time = 0.0;              ///< [s] simulated
    double end = 0.0;               ///< [s] simulated, at which the loop ends at the latest
    std::int64_t steps = 0;         ///< taken by this loop
    double steps_per_second = 0.0;  ///< of wall clock, mean so far
    double seconds_left = 0.0;      ///< [s] of wall clock at that rate
};

using ProgressCallback = std::function<void(const Progress&)>;

/// What the outside has to say in a loop of steps: when to stop, and whom to tell how far it is.
struct LoopControl {
    const std::atomic<bool>* stop = nullptr;  ///< set from anywhere, also a signal handler; may be null
    ProgressCallback progress;                ///< called a few times a second of wall clock; may be empty

    bool stop_requested() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

/// Measures the rate of a loop and calls LoopControl::progress now and then.
class ProgressMeter {
public:
    /// The loop goes on for `steps` steps of `dt` [s] at most, from time zero.
    ProgressMeter(const LoopControl& control, std::int64_t steps, double dt);
    void after_step(std::int64_t done);

private:
    using Clock = std::chrono::steady_clock;
    const LoopControl& control_;
    std::int64_t steps_;
    double dt_;
    Clock::time_point start_, last_;
};

}  // namespace polargrain
