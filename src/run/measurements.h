#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/model/settings.h"
#include "src/observe/observer.h"
#include "src/observe/reduction.h"
#include "src/run/sink.h"

namespace polargrain {

/// What each expectation's value is called in summary.json: its label, or the quantity, with "_mean" and the like for
/// another statistic than the last reading; where that is taken, by another or by a standard observable that it is not,
/// "_2", "_3" follow.
std::vector<std::string> expectation_labels(const std::vector<Expectation>& expectations);

/// Measures, during a run, what the summary tells: the standard observables and those of the expectations.
class Measurements final : public Sink {
public:
    /// every: between readings [s]; 0: only at the beginning and the end.
    Measurements(std::vector<Expectation> expectations, double every);

    double every() const override { return every_; }
    void begin(const Scene& scene, const RunInfo& info) override;
    void save(Checkpoint& checkpoint) override;
    void resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) override;
    void step(const World& world, double dt, const StepReport& report) override;
    void sample(const Sample& sample) override;

    /// By label, in SI units; those that have no value are left out.
    std::map<std::string, double> values() const;

private:
    struct Measured {
        std::string label;
        Observer observer;
        Reduction reduction;
    };

    std::vector<Expectation> expectations_;
    double every_;
    std::vector<Measured> measured_;
};

/// Interval of readings for expectations [s]: that of series.csv, or a hundredth of the run where there is none.
double reading_interval(const OutputSettings& output, double duration);

}  // namespace polargrain
