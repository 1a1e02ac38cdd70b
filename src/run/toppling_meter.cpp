#include "src/run/toppling_meter.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

constexpr double k_toppling = 0.02;  // rad

}  // namespace

void TopplingMeter::begin(const Scene& scene, const RunInfo& info) {
    gravity_ = std::sqrt(scene.gravity.squaredNorm());
    const Vec2 up = gravity_ > 0.0 ? Vec2(-scene.gravity / gravity_) : Vec2(Vec2::UnitY());
    stood_at_ = scene.grains.x;
    angle_ = scene.grains.angle;
    height_.clear();
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        height_.push_back(2.0 * (up.dot(scene.grains.position(k)) - info.lowest));
    }
    toppled_at_.assign(stood_at_.size(), -1.0);
}

void TopplingMeter::step(const World& world, double /*dt*/, const StepReport& /*report*/) {
    for (std::size_t k = 0; k < toppled_at_.size(); ++k) {
        if (toppled_at_[k] < 0.0 && std::abs(world.grains.angle[k] - angle_[k]) > k_toppling) {
            toppled_at_[k] = world.time;
        }
    }
}

void TopplingMeter::sample(const Sample& /*sample*/) {}

double TopplingMeter::speed() const {
    std::vector<std::size_t> toppled;
    for (std::size_t k = 0; k < toppled_at_.size(); ++k) {
        if (toppled_at_[k] >= 0.0) toppled.push_back(k);
    }
    if (toppled.size() < 4) return std::nan("");
    std::sort(toppled.begin(), toppled.end(),
              [this](std::size_t p, std::size_t q) { return stood_at_[p] < stood_at_[q]; });
    const std::size_t first = toppled[toppled.size() / 2];
    const std::size_t last = toppled.back();
    const double speed = std::abs((stood_at_[last] - stood_at_[first]) / (toppled_at_[last] - toppled_at_[first]));
    return speed / std::sqrt(gravity_ * height_[first]);
}

}  // namespace polargrain
