#include "src/observe/reduction.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

void Reduction::add(double time, double reading) {
    if (!std::isfinite(reading) || (from_ && time < *from_) || (to_ && time > *to_)) return;
    if (count_ == 0.0) {
        first_ = reading;
        least_ = reading;
        greatest_ = reading;
    }
    count_ += 1.0;
    sum_ += reading;
    least_ = std::min(least_, reading);
    greatest_ = std::max(greatest_, reading);
    last_ = reading;
}

double Reduction::value() const {
    if (count_ == 0.0) return std::nan("");
    switch (statistic_) {
        case Statistic::last: return last_;
        case Statistic::mean: return sum_ / count_;
        case Statistic::minimum: return least_;
        case Statistic::maximum: return greatest_;
        case Statistic::change: break;
    }
    return last_ - first_;
}

void Reduction::set_state(const std::vector<double>& state) {
    count_ = state.at(0);
    sum_ = state.at(1);
    least_ = state.at(2);
    greatest_ = state.at(3);
    first_ = state.at(4);
    last_ = state.at(5);
}

const std::vector<std::string>& statistic_names() {
    static const std::vector<std::string> names = {"last", "mean", "min", "max", "change"};
    return names;
}

std::string to_string(Statistic statistic) { return statistic_names()[static_cast<std::size_t>(statistic)]; }

}  // namespace polargrain
