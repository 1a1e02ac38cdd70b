#include "src/model/wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

WallState state_of(const LinearMotion& motion, double time) {
    if (time < motion.start) return {};
    const bool ended = motion.end && time >= *motion.end;
    WallState state;
    state.pose.centre = motion.velocity * ((ended ? *motion.end : time) - motion.start);
    if (!ended) state.velocity = motion.velocity;
    state.origin = state.pose.centre;
    return state;
}

/// From when to when a wall moves [s].
struct Interval {
    double from, to;

    bool holds(const Interval& part) const { return from <= part.from && part.to <= to; }
    bool meets(const Interval& other) const { return from < other.to && other.from < to; }
};

constexpr double k_infinity = std::numeric_limits<double>::infinity();

Interval since(double start) { return {start > 0.0 ? start : -k_infinity, k_infinity}; }

Interval time_of(const std::monostate&) { return {k_infinity, k_infinity}; }
Interval time_of(const SineMotion& motion) { return since(motion.start); }
Interval time_of(const RotationMotion& motion) { return since(motion.start); }
Interval time_of(const LinearMotion& motion) { return {since(motion.start).from, motion.end.value_or(k_infinity)}; }

Interval moving_time(const Wall& wall) {
    return std::visit([](const auto& motion) { return time_of(motion); }, wall.motion);
}

Interval around(double middle, double length) { return {middle - 0.5 * length, middle + 0.5 * length}; }

double top_speed(const std::monostate&, const Wall&) { return 0.0; }

double top_speed(const SineMotion& motion, const Wall&) {
    return 2.0 * k_pi * motion.frequency * std::abs(motion.amplitude);
}

double top_speed(const RotationMotion& motion, const Wall& wall) {
    double reach = 0.0;
    for (const Vec2& p : wall.points) reach = std::max(reach, std::sqrt((p - motion.centre).squaredNorm()));
    return std::abs(motion.rate) * reach;
}

double top_speed(const LinearMotion& motion, const Wall&) { return std::sqrt(motion.velocity.squaredNorm()); }

}  // namespace

WallState wall_state(const Wall& wall, double time) {
    return std::visit([time](const auto& motion) { return state_of(motion, time); }, wall.motion);
}

WallState wall_state_over(const Wall& wall, double middle, double length) {
    if (!starts_or_ends(wall, middle, length)) return wall_state(wall, middle);
    const Interval all = around(middle, length);
    const Interval moving = moving_time(wall);
    const Interval part{std::max(all.from, moving.from), std::min(all.to, moving.to)};
    const double share = (part.to - part.from) / length;
    const WallState moved = wall_state(wall, 0.5 * (part.from + part.to));
    WallState state = wall_state(wall, middle);
    state.velocity = share * moved.velocity;
    state.origin = moved.origin;
    state.spin = share * moved.spin;
    return state;
}

bool moves_between(const Wall& wall, double from, double to) { return moving_time(wall).meets({from, to}); }

bool starts_or_ends(const Wall& wall, double middle, double length) {
    const Interval all = around(middle, length);
    const Interval moving = moving_time(wall);
    return moving.meets(all) && !moving.holds(all);
}

std::vector<Vec2> points_at_rest(const Wall& wall) {
    std::vector<Vec2> points = wall.points;
    const double end = moving_time(wall).to;
    if (!wall.moves() || end == k_infinity) return points;
    const WallState after = wall_state(wall, end);
    for (const Vec2& p : wall.points) points.push_back(after.point(p));
    return points;
}

double largest_speed(const Wall& wall) {
    return std::visit([&wall](const auto& motion) { return top_speed(motion, wall); }, wall.motion);
}

}  // namespace polargrain
