#include "src/model/wall.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

WallState state_of(const std::monostate&, double) { return {}; }

WallState state_of(const SineMotion& motion, double time) {
    if (time < motion.start) return {};
    const double rate = 2.0 * k_pi * motion.frequency;
    // Whole periods are dropped first, so that the phase stays exact however long the run.
    const double periods = motion.frequency * (time - motion.start);
    const auto [sine, cosine] = sine_cosine(2.0 * k_pi * (periods - std::floor(periods)));
    WallState state;
    state.pose.centre = motion.direction * (motion.amplitude * sine);
    state.velocity = motion.direction * (motion.amplitude * rate * cosine);
    state.origin = state.pose.centre;
    return state;
}

WallState state_of(const RotationMotion& motion, double time) {
    if (time < motion.start) return {};
    const double turns = motion.rate * (time - motion.start) / (2.0 * k_pi);
    WallState state;
    state.pose = Pose::at(Vec2::Zero(), 2.0 * k_pi * (turns - std::floor(turns)));
    state.pose.centre = motion.centre - state.pose.turned(motion.centre);
    state.spin = motion.rate;
    state.origin = motion.centre;  // the fixed point: any point with a known velocity serves
    return state;
}

double top_speed(const std::monostate&, const Wall&) { return 0.0; }

double top_speed(const SineMotion& motion, const Wall&) {
    return 2.0 * k_pi * motion.frequency * std::abs(motion.amplitude);
}

double top_speed(const RotationMotion& motion, const Wall& wall) {
    double reach = 0.0;
    for (const Vec2& p : wall.points) reach = std::max(reach, std::sqrt((p - motion.centre).squaredNorm()));
    return std::abs(motion.rate) * reach;
}

}  // namespace

WallState wall_state(const Wall& wall, double time) {
    return std::visit([time](const auto& motion) { return state_of(motion, time); }, wall.motion);
}

double largest_speed(const Wall& wall) {
    return std::visit([&wall](const auto& motion) { return top_speed(motion, wall); }, wall.motion);
}

}  // namespace polargrain
