#pragma once

#include <cstdint>
#include <string>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"

namespace polargrain {

/// Deepest overlap of any two grains, or of a grain and a wall that is there at that time, found on the whole outlines
/// by the contact finder [m]: the depth of the deepest vertex behind the edge it went through (disks: of the deepest
/// point). Zero where nothing overlaps beyond k_touch_tolerance. Independent of the engine.
double deepest_overlap(const Scene& scene, const World& world);

/// The deepest overlap since time zero, of every twentieth step: to look at all outlines takes about as long as a step.
class OverlapMeter {
public:
    static constexpr std::int64_t k_steps_between = 20;

    explicit OverlapMeter(const Scene& scene);

    void step(const World& world, double dt, const StepReport& report);
    double read(const Sample& /*sample*/) const { return deepest_; }
    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    const Scene* scene_;
    double deepest_ = 0.0;
};

}  // namespace polargrain
