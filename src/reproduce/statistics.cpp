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

namespace {

/// Twice the rank, less one: how many are smaller, and how many are not larger.
std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<double> result;
    for (const double v : values) {
        double rank = 0.0;
        for (const double other : values) rank += (other < v ? 1.0 : 0.0) + (other <= v ? 1.0 : 0.0);
        result.push_back(rank);
    }
    return result;
}

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> of_a, of_b;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (!std::isfinite(a[k]) || !std::isfinite(b[k])) continue;
        of_a.push_back(a[k]);
        of_b.push_back(b[k]);
    }
    const std::vector<double> rank_a = ranks(of_a), rank_b = ranks(of_b);
    const double mean_a = mean_and_spread(rank_a).mean, mean_b = mean_and_spread(rank_b).mean;
    double both = 0.0, only_a = 0.0, only_b = 0.0;
    for (std::size_t k = 0; k < rank_a.size(); ++k) {
        both += (rank_a[k] - mean_a) * (rank_b[k] - mean_b);
        only_a += (rank_a[k] - mean_a) * (rank_a[k] - mean_a);
        only_b += (rank_b[k] - mean_b) * (rank_b[k] - mean_b);
    }
    return only_a > 0.0 && only_b > 0.0 ? both / std::sqrt(only_a * only_b) : std::nan("");
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
