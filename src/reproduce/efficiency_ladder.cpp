#include "src/reproduce/efficiency_ladder.h"

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

double standard_error(const std::vector<double>& values) {
    const auto finite = std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    return finite > 0 ? mean_and_spread(values).spread / std::sqrt(static_cast<double>(finite)) : std::nan("");
}

}  // namespace

ConvergedValue converged_value(const std::vector<Rung>& finest) {
    std::vector<double> means;
    double squares = 0.0;
    for (const Rung& rung : finest) {
        means.push_back(mean_and_spread(rung.values).mean);
        const double error = standard_error(rung.values);
        squares += error * error;
    }
    if (means.empty()) return {std::nan(""), std::nan("")};
    const auto [least, most] = std::minmax_element(means.begin(), means.end());
    const double of_mean = std::sqrt(squares) / static_cast<double>(means.size());
    return {mean_and_spread(means).mean, std::max(0.5 * (*most - *least), of_mean)};
}

RungResult rung_result(const Rung& rung, const ConvergedValue& converged) {
    const MeanSpread value = mean_and_spread(rung.values);
    return {rung.label,
            mean_and_spread(rung.costs).mean,
            value.mean,
            value.spread,
            std::abs(value.mean - converged.value) / std::abs(converged.value),
            standard_error(rung.values) / std::abs(converged.value)};
}

std::optional<RungResult> cheapest_right(const std::vector<RungResult>& ladder, double tolerance) {
    std::optional<RungResult> cheapest;
    for (std::size_t k = ladder.size(); k-- > 0;) {
        const RungResult& rung = ladder[k];
        if (!(rung.error <= tolerance)) break;
        if (!cheapest || rung.cost < cheapest->cost) cheapest = rung;
    }
    return cheapest;
}

}  // namespace polargrain
