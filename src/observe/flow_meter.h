#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"
#include "src/observe/kind.h"

namespace polargrain {

/// Counts marked grains that leave: through an opening, or out of the walls (is_out) where none is given.
///
/// A grain passes an opening when the way of its centre during a step crosses the line between the two ends, with
/// gravity (without gravity: from left to right as seen from the first end to the second); the other way counts against
/// it.
class FlowMeter {
public:
    enum class Measure {
        count,       ///< grains since time zero
        area_rate,   ///< area of grains per time, mean since the previous reading [m^2/s]
        grain_rate,  ///< grains per time, mean since the previous reading [1/s]
    };

    FlowMeter(const Scene& scene, GrainMask mask, std::optional<Opening> opening, Measure measure);

    void step(const World& world, double dt, const StepReport& report);
    double read(const Sample& sample);

    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    /// +1: leaves in this step, -1: comes back.
    int passage(GrainIndex k, const Vec2& from, const Vec2& to) const;

    const Scene* scene_;
    GrainMask mask_;
    std::optional<Opening> opening_;
    Measure measure_;
    std::optional<double> outlet_;
    std::vector<double> x_, y_;  // before the step [m]
    double count_ = 0.0;
    double grains_ = 0.0, area_ = 0.0, interval_ = 0.0;  // since the previous reading
};

}  // namespace polargrain
