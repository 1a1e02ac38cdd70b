#pragma once

#include <string>

#include "src/model/checkpoint.h"
#include "src/model/sample.h"
#include "src/observe/kind.h"

namespace polargrain {

/// An observable that a state and the sums of a run give, without a memory of its own but for which grains it is about.
class Snapshot {
public:
    using Value = double (*)(const Snapshot&, const Sample&);

    Snapshot(ObservableSpec the_spec, GrainMask the_mask, Value value)
        : spec(std::move(the_spec)), mask(std::move(the_mask)), value_(value) {}

    void step(const World& /*world*/, double /*dt*/, const StepReport& /*report*/) {}
    double read(const Sample& sample) const { return value_(*this, sample); }
    void save(Checkpoint& /*checkpoint*/, const std::string& /*prefix*/) const {}
    void load(const Checkpoint& /*checkpoint*/, const std::string& /*prefix*/) {}

    ObservableSpec spec;
    GrainMask mask;

private:
    Value value_;
};

/// The function behind an observable of that name; null where it needs more than a state and the sums.
Snapshot::Value find_snapshot(const std::string& quantity);

/// E0: kinetic energy, and potential energy above the lowest point of the scene, at time zero [J/m].
double initial_energy(const Scene& scene);

}  // namespace polargrain
