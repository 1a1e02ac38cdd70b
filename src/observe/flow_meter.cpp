#include "src/observe/flow_meter.h"

#include <cmath>
#include <utility>

#include "src/core/error.h"
#include "src/observe/bed.h"

namespace polargrain {

FlowMeter::FlowMeter(const Scene& scene, GrainMask mask, std::optional<Opening> opening, Measure measure)
    : scene_(&scene),
      mask_(std::move(mask)),
      opening_(std::move(opening)),
      measure_(measure),
      outlet_(outlet_height(scene)),
      x_(scene.grains.x),
      y_(scene.grains.y) {
    require(opening_ || outlet_,
            "grains that leave are counted below the lowest wall: without walls or gravity, give `opening`");
    if (!opening_) return;
    // From left to right of the line is with gravity.
    const Vec2 along = opening_->to - opening_->from;
    if (right_normal(along).dot(scene.gravity) < 0.0) std::swap(opening_->from, opening_->to);
}

int FlowMeter::passage(GrainIndex k, const Vec2& from, const Vec2& to) const {
    if (!opening_) {
        return static_cast<int>(is_out(*scene_, *outlet_, k, to)) -
               static_cast<int>(is_out(*scene_, *outlet_, k, from));
    }
    const Vec2 along = opening_->to - opening_->from;
    const double before = cross(along, from - opening_->from);
    const double after = cross(along, to - opening_->from);
    if ((before > 0.0) == (after > 0.0)) return 0;
    const Vec2 at = from + before / (before - after) * (to - from);
    const double station = along.dot(at - opening_->from);
    if (station < 0.0 || station > along.squaredNorm()) return 0;
    return before > 0.0 ? 1 : -1;
}

void FlowMeter::step(const World& world, double dt, const StepReport& /*report*/) {
    for (GrainIndex k = 0; k < world.grains.size(); ++k) {
        const std::size_t i = Grains::at(k);
        if (mask_[i] == 0) continue;
        const int passed = passage(k, {x_[i], y_[i]}, world.grains.position(k));
        x_[i] = world.grains.x[i];
        y_[i] = world.grains.y[i];
        if (passed == 0) continue;
        count_ += passed;
        grains_ += passed;
        area_ += passed * area(scene_->shape_of(k));
    }
    interval_ += dt;
}

double FlowMeter::read(const Sample& /*sample*/) {
    if (measure_ == Measure::count) return count_;
    const double passed = measure_ == Measure::area_rate ? area_ : grains_;
    const double rate = interval_ > 0.0 ? passed / interval_ : std::nan("");
    grains_ = 0.0;
    area_ = 0.0;
    interval_ = 0.0;
    return rate;
}

void FlowMeter::save(Checkpoint& checkpoint, const std::string& prefix) const {
    checkpoint.put(prefix + "/flow_x", x_);
    checkpoint.put(prefix + "/flow_y", y_);
    checkpoint.put(prefix + "/flow", std::vector{count_, grains_, area_, interval_});
}

void FlowMeter::load(const Checkpoint& checkpoint, const std::string& prefix) {
    x_ = checkpoint.reals(prefix + "/flow_x");
    y_ = checkpoint.reals(prefix + "/flow_y");
    const std::vector<double>& sums = checkpoint.reals(prefix + "/flow");
    count_ = sums.at(0);
    grains_ = sums.at(1);
    area_ = sums.at(2);
    interval_ = sums.at(3);
}

}  // namespace polargrain
