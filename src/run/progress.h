#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "src/model/checkpoint.h"

namespace polargrain {

/// How far a loop of steps has come.
struct Progress {
    double time = 0.0;              ///< [s] simulated
    double end = 0.0;               ///< [s] simulated, at which the loop ends at the latest
    std::int64_t steps = 0;         ///< taken since time zero
    double steps_per_second = 0.0;  ///< of wall clock, mean so far
    double seconds_left = 0.0;      ///< [s] of wall clock at that rate
};

using ProgressCallback = std::function<void(const Progress&)>;

/// Receives everything that carries a loop of steps on from where it is.
using KeepCheckpoint = std::function<void(const Checkpoint&)>;

/// What the outside has to say in a loop of steps: when to stop, whom to tell how far it is, who keeps checkpoints.
struct LoopControl {
    const std::atomic<bool>* stop = nullptr;  ///< set from anywhere, also a signal handler; may be null
    ProgressCallback progress = {};           ///< called a few times a second of wall clock; may be empty
    KeepCheckpoint keep = {};                 ///< called when the loop begins and ends, and in between; may be empty
    double keep_every = 0.0;                  ///< [s] of wall clock between two calls; 0: none in between

    bool stop_requested() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

/// Measures the rate of a loop and calls LoopControl::progress now and then.
class ProgressMeter {
public:
    /// The loop goes on to step `steps` at most, from step `first` of `dt` [s] each.
    ProgressMeter(const LoopControl& control, std::int64_t first, std::int64_t steps, double dt);
    void after_step(std::int64_t done);

private:
    using Clock = std::chrono::steady_clock;
    const LoopControl& control_;
    std::int64_t first_;
    std::int64_t steps_;
    double dt_;
    Clock::time_point start_, last_;
};

/// Tells when the next checkpoint is due: so long after the previous one was done that even slow ones leave time to
/// run.
class CheckpointClock {
public:
    explicit CheckpointClock(const LoopControl& control) : control_(control), last_(Clock::now()) {}
    bool due() const;
    void kept() { last_ = Clock::now(); }

private:
    using Clock = std::chrono::steady_clock;
    const LoopControl& control_;
    Clock::time_point last_;
};

}  // namespace polargrain
