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

/// The deepest overlap since time zero: of the outlines at readings that are k_steps_between or more apart, as looking
/// at all of them takes about as long as a step, and of what the engine tells of every step.
class OverlapMeter {
public:
    static constexpr std::int64_t k_steps_between = 20;

    void step(const World& /*world*/, double /*dt*/, const StepReport& /*report*/) {}
    double read(const Sample& sample);
    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    double deepest_ = 0.0;
    std::int64_t looked_at_ = -k_steps_between;  // step
};

}  // namespace polargrain
