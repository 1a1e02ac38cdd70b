#include "src/reproduce/statistics.h"

#include <cmath>

namespace polargrain {

MeanSpread mean_and_spread(const std::vector<double>& values) {
    double sum = 0.0, count = 0.0;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        sum += v;
        count += 1.0;
    }
    if (count == 0.0) return {std::nan(""), std::nan("")};
    const double mean = sum / count;
    double squares = 0.0;
    for (const double v : values) {
        if (std::isfinite(v)) squares += (v - mean) * (v - mean);
    }
    return {mean, count > 1.0 ? std::sqrt(squares / (count - 1.0)) : 0.0};
}

Series histogram(const std::vector<double>& values, double low, double high, int bins, const std::string& label,
                 int colour) {
    Series series{.label = label, .style = SeriesStyle::bars, .colour = colour};
    const double width = (high - low) / bins;
    for (int b = 0; b < bins; ++b) {
        series.x.push_back(low + (b + 0.5) * width);
        series.y.push_back(0.0);
    }
    for (const double v : values) {
        const double bin = std::floor((v - low) / width);
        if (bin >= 0.0 && bin < bins) series.y[static_cast<std::size_t>(bin)] += 1.0;
    }
    return series;
}

}  // namespace polargrain
