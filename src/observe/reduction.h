#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/model/settings.h"

namespace polargrain {

/// Makes one number of an observable's readings, leaving out those that are no numbers and those outside the window
/// [from, to]. A reading is taken at the first step at or after its time: the one that is due at `to` lies outside
/// where no step falls on it.
class Reduction {
public:
    Reduction(Statistic statistic, std::optional<double> from, std::optional<double> to)
        : statistic_(statistic), from_(from), to_(to) {}

    void add(double time, double reading);
    /// NaN where there was no reading.
    double value() const;

    std::vector<double> state() const { return {count_, sum_, least_, greatest_, first_, last_}; }
    void set_state(const std::vector<double>& state);

private:
    Statistic statistic_;
    std::optional<double> from_, to_;  // [s]
    double count_ = 0.0, sum_ = 0.0, least_ = 0.0, greatest_ = 0.0, first_ = 0.0, last_ = 0.0;
};

/// "last", "mean", "min", "max", "change": as in scenario files.
const std::vector<std::string>& statistic_names();
std::string to_string(Statistic statistic);

}  // namespace polargrain
