#include "src/observe/toppling_meter.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "src/observe/bed.h"

namespace polargrain {

namespace {

constexpr double k_toppling = 0.02;  // rad
constexpr double k_steady = 0.05;    // share of the natural speed
/// Single pitches of bouncing dominoes differ by up to a quarter.
constexpr std::size_t k_behind = 2, k_ahead = 3;
constexpr std::size_t k_shortest_row = 12;
constexpr double k_level = 0.1;  // of the mean height, between centres in a row

/// height: twice those of the centres above the lowest point of the scene.
bool stand_in_a_row(const Scene& scene, const std::vector<double>& height) {
    double mean = 0.0;
    for (const double h : height) mean += h / static_cast<double>(height.size());
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        if (std::holds_alternative<Disk>(scene.shape_of(k))) return false;
        if (!(std::abs(height[Grains::at(k)] - mean) <= k_level * mean)) return false;
    }
    return true;
}

}  // namespace

TopplingMeter::TopplingMeter(const Scene& scene, Measure measure)
    : measure_(measure),
      stood_at_(scene.grains.x),
      angle_(scene.grains.angle),
      toppled_at_(scene.grains.x.size(), -1.0),
      gravity_(std::sqrt(scene.gravity.squaredNorm())) {
    const Vec2 up = upwards(scene);
    const double lowest = largest_drop(scene).lowest;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        height_.push_back(2.0 * (up.dot(scene.grains.position(k)) - lowest));
    }
    in_a_row_ = stand_in_a_row(scene, height_);
}

void TopplingMeter::step(const World& world, double /*dt*/, const StepReport& /*report*/) {
    for (std::size_t k = 0; k < toppled_at_.size(); ++k) {
        if (toppled_at_[k] < 0.0 && std::abs(world.grains.angle[k] - angle_[k]) > k_toppling) {
            toppled_at_[k] = world.time;
        }
    }
}

std::vector<std::size_t> TopplingMeter::toppled_in_order() const {
    std::vector<std::size_t> toppled;
    if (!in_a_row_) return toppled;
    for (std::size_t k = 0; k < toppled_at_.size(); ++k) {
        if (toppled_at_[k] >= 0.0) toppled.push_back(k);
    }
    std::sort(toppled.begin(), toppled.end(),
              [this](std::size_t p, std::size_t q) { return stood_at_[p] < stood_at_[q]; });
    const bool leftwards = !toppled.empty() && toppled_at_[toppled.front()] > toppled_at_[toppled.back()];
    if (leftwards) std::reverse(toppled.begin(), toppled.end());
    return toppled;
}

double TopplingMeter::between(std::size_t first, std::size_t last) const {
    return std::abs((stood_at_[last] - stood_at_[first]) / (toppled_at_[last] - toppled_at_[first]));
}

double TopplingMeter::speed() const {
    const std::vector<std::size_t> toppled = toppled_in_order();
    if (toppled.size() < 4) return std::nan("");
    const std::size_t first = toppled[toppled.size() / 2];
    return between(first, toppled.back()) / std::sqrt(gravity_ * height_[first]);
}

double TopplingMeter::run_in() const {
    const std::vector<std::size_t> toppled = toppled_in_order();
    if (toppled.size() < k_shortest_row) return std::nan("");
    const double natural = between(toppled[toppled.size() / 2], toppled.back());
    std::size_t steady_from = k_behind;
    for (std::size_t k = k_behind; k + k_ahead < toppled.size(); ++k) {
        const double speed = between(toppled[k - k_behind], toppled[k + k_ahead]);
        if (std::abs(speed / natural - 1.0) > k_steady) steady_from = k + 1;
    }
    return static_cast<double>(steady_from);
}

void TopplingMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/toppled_at", toppled_at_);
}

void TopplingMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    toppled_at_ = checkpoint.reals(prefix + "/toppled_at");
}

}  // namespace polargrain
