#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/model/settings.h"
#include "src/observe/observer.h"
#include "src/observe/reduction.h"

namespace polargrain {

/// A number that runs of different engines are compared by.
struct Quantity {
    std::string name;  ///< in files
    std::string unit;  ///< empty for a ratio or a count
};

/// Everything that a run is compared by, measured alike for every engine.
///
/// Kinetic and potential energy per grain, how near to rest (rest_energy of src/run/settle.h), centre of mass, grains
/// out and whether their flow has stopped, pairs that touch, the deepest overlap of the whole outlines by our own
/// predicate at that instant (whatever the engine believes), moves rejected, energy created; then what the scenario
/// expects, and what it observes.
class Meters {
public:
    /// The scene and the expectations outlive it.
    Meters(const Scene& scene, const std::vector<Expectation>& expectations,
           const std::vector<ObservableSpec>& observed, double duration);

    const std::vector<Quantity>& quantities() const { return quantities_; }
    void step(const World& world, double dt, const StepReport& report);
    /// One reading of each quantity, NaN where there is none.
    std::vector<double> read(const Sample& sample);
    /// One number for each quantity, of all readings so far: mean, largest or last, as suits it.
    std::vector<double> values() const;

private:
    void add(const std::string& quantity, Statistic statistic);
    void add(const ObservableSpec& spec, const Reduction& reduction, const std::string& name);
    void add_own(const std::string& name, const std::string& unit, Statistic statistic);
    double stopped(const Sample& sample);

    const Scene& scene_;
    double duration_;
    std::vector<Quantity> quantities_;
    std::vector<Reduction> reductions_;
    std::vector<Observer> observers_;  ///< of the last quantities
    double start_potential_ = 0.0;     ///< [J/m]
    double mean_diameter_ = 0.0;       ///< [m]
    GrainIndex out_ = 0;
    double last_exit_ = 0.0;  ///< [s]
};

}  // namespace polargrain
