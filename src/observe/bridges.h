#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"
#include "src/observe/kind.h"

namespace polargrain {

/// The grains of the shortest bridge over an opening, from one abutment to the other; empty where nothing bridges it.
///
/// Only grains above the opening (against gravity) and nearer to its middle than its width W and a mean outer diameter
/// count, and only while they stand still: slower than 0.05 sqrt(g W). A bridge is a chain of such grains in contact
/// that leads from one side to the other; it ends at a grain that touches a wall on its own side of the middle, or
/// whose centre lies beyond its end of the opening and rests on grains that are no part of the flow. After the arches
/// of [T01], which block an outlet. InputError without gravity.
std::vector<GrainIndex> find_bridge(const Scene& scene, const Grains& grains, std::span<const Contact> contacts,
                                    const Opening& opening);

/// Follows the bridges over an opening from step to step.
///
/// A bridge lives from the first step at which one is found to the last; gaps shorter than sqrt(d/g), d the mean outer
/// diameter of the grains, do not end it. One that lived no longer than that does not count.
class BridgeMeter {
public:
    enum class Measure {
        count,       ///< bridges since time zero, the standing one with them
        life,        ///< their mean life [s]; NaN without any
        time_share,  ///< of the time since time zero, what bridges lived
        grains,      ///< in the standing bridge, zero without one
    };

    BridgeMeter(const Scene& scene, Opening opening, Measure measure);

    void step(const World& world, double dt, const StepReport& report);
    double read(const Sample& sample) const;

    /// Life times [s] of all that count, in order, the standing one last.
    std::vector<double> lives() const;

    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    const Scene* scene_;
    Opening opening_;
    Measure measure_;
    double least_ = 0.0;         // [s]
    std::vector<double> ended_;  // [s]
    double first_seen_ = -1.0;   // [s]; negative: none stands
    double last_seen_ = -1.0;    // [s]
    double standing_grains_ = 0.0;
};

}  // namespace polargrain
