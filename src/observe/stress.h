#pragma once

#include <optional>
#include <string>
#include <utility>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"
#include "src/observe/structure.h"

namespace polargrain {

/// What the contacts whose points lie in a region add to the sum of impulse times branch, symmetrised [N s]; the
/// branch runs from centre to centre of mass, for a wall from the contact point to the grain's centre. Positive where
/// grains press on one another.
SymmetricTensor contact_moment(const Grains& grains, std::span<const Contact> contacts, const Region& region);

/// Contact stress in a region, compression positive [Pa]: the sum of force times branch over the area of the region,
/// mean over the time since the previous reading. [W66; CM81] Contacts belong to the region in which their point
/// lies, with their whole branch: make it several grains wide.
class StressMeter {
public:
    enum class Component { xx, xy, yy, pressure };

    StressMeter(Region region, Component component) : region_(std::move(region)), component_(component) {}

    void step(const World& world, double dt, const StepReport& report);
    /// Ends the interval. NaN where no time has gone by.
    double read(const Sample& sample);
    SymmetricTensor stress() const;

    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    Region region_;
    Component component_;
    SymmetricTensor moment_;  // [N s]
    double interval_ = 0.0;   // [s]
};

/// Length of a wall within a region, where the wall is at that time [m].
double wall_length(const Wall& wall, double time, const std::optional<Region>& region);

/// What the grains do to a wall, mean over the time since the previous reading.
class WallMeter {
public:
    enum class Measure {
        pressure,     ///< normal force over the length of the wall in the region [Pa]
        weight_share  ///< force along gravity over the weight of the grains that are in
    };

    /// wall: its index in the scene. The region concerns contact points and the wall's length; none: the whole wall.
    WallMeter(int wall, std::optional<Region> region, Measure measure)
        : wall_(wall), region_(std::move(region)), measure_(measure) {}

    void step(const World& world, double dt, const StepReport& report);
    /// Ends the interval. NaN where no time has gone by, the wall is gone or nothing of it lies in the region.
    double read(const Sample& sample);

    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    double value(const Sample& sample) const;

    int wall_;
    std::optional<Region> region_;
    Measure measure_;
    double normal_ = 0.0;        // impulse into the wall [N s/m]
    Vec2 total_ = Vec2::Zero();  // on the wall [N s/m]
    double interval_ = 0.0;      // [s]
};

}  // namespace polargrain
