#pragma once

#include <memory>
#include <string>

#include "src/model/checkpoint.h"
#include "src/model/observable_spec.h"
#include "src/model/sample.h"
#include "src/observe/observable_table.h"

namespace polargrain {

/// One observable at work on a run: sees every step and is read now and then.
///
/// The scene, as it is at time zero, outlives it.
class Observer {
public:
    /// InputError where there is no such observable (with the nearest one), where a parameter is missing or is not
    /// taken, or where the scene has no such wall, shape or material.
    Observer(const ObservableSpec& spec, const Scene& scene);
    ~Observer();
    Observer(Observer&&) noexcept;
    Observer& operator=(Observer&&) noexcept;

    const ObservableSpec& spec() const { return spec_; }
    const ObservableEntry& entry() const { return *entry_; }
    /// What it is called in files: the spec's label, or the quantity.
    const std::string& label() const { return spec_.label.empty() ? spec_.quantity : spec_.label; }

    /// After every step.
    void step(const World& world, double dt, const StepReport& report);

    /// Its value in SI units, NaN where it has none. Ends the interval that rates and forces are means over.
    double read(const Sample& sample);

    /// What later values depend on; keys begin with `prefix`. load(save()) changes no later bit.
    void save(Checkpoint& checkpoint, const std::string& prefix) const;
    void load(const Checkpoint& checkpoint, const std::string& prefix);

private:
    struct Meter;

    ObservableSpec spec_;
    const ObservableEntry* entry_;
    std::unique_ptr<Meter> meter_;
};

/// What Observer's constructor refuses.
void check_observable(const ObservableSpec& spec, const Scene& scene);

}  // namespace polargrain
