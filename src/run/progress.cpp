#include "src/run/progress.h"

namespace polargrain {

namespace {

constexpr std::chrono::milliseconds k_between_calls{100};

}  // namespace

ProgressMeter::ProgressMeter(const LoopControl& control, std::int64_t first, std::int64_t steps, double dt)
    : control_(control), first_(first), steps_(steps), dt_(dt), start_(Clock::now()), last_(start_) {}

void ProgressMeter::after_step(std::int64_t done) {
    if (!control_.progress) return;
    const Clock::time_point now = Clock::now();
    if (now - last_ < k_between_calls) return;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double rate = static_cast<double>(done - first_) / elapsed;
    control_.progress({static_cast<double>(done) * dt_, static_cast<double>(steps_) * dt_, done, rate,
                       static_cast<double>(steps_ - done) / rate});
}

bool CheckpointClock::due() const {
    return control_.keep && control_.keep_every > 0.0 &&
           std::chrono::duration<double>(Clock::now() - last_).count() >= control_.keep_every;
}

}  // namespace polargrain
