#include "src/observe/toppling_meter.h"

#include <algorithm>
#include <cmath>

#include "src/observe/bed.h"

namespace polargrain {

namespace {

constexpr double k_toppling = 0.02;  // rad

}  // namespace

TopplingMeter::TopplingMeter(const Scene& scene)
    : stood_at_(scene.grains.x),
      angle_(scene.grains.angle),
      toppled_at_(scene.grains.x.size(), -1.0),
      gravity_(std::sqrt(scene.gravity.squaredNorm())) {
    const Vec2 up = upwards(scene);
    const double lowest = largest_drop(scene).lowest;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        height_.push_back(2.0 * (up.dot(scene.grains.position(k)) - lowest));
    }
}

void TopplingMeter::step(const World& world, double /*dt*/, const StepReport& /*report*/) {
    for (std::size_t k = 0; k < toppled_at_.size(); ++k) {
        if (toppled_at_[k] < 0.0 && std::abs(world.grains.angle[k] - angle_[k]) > k_toppling) {
            toppled_at_[k] = world.time;
        }
    }
}

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

void TopplingMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/toppled_at", toppled_at_);
}

void TopplingMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    toppled_at_ = checkpoint.reals(prefix + "/toppled_at");
}

}  // namespace polargrain
