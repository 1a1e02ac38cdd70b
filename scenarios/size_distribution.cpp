#include "scenarios/size_distribution.h"

#include <cmath>

#include "src/core/elementary.h"

namespace polargrain {

namespace {

constexpr NumberRange k_factor{1e-3, 1e3, "between 1e-3 and 1e3"};
// Grains without a given limit stay within this many standard deviations.
constexpr double k_tail = 3.0;

/// Standard deviation and mean of the logarithm of a lognormal factor.
struct LogParameters {
    double mean, stddev;
};

LogParameters log_parameters(double mean, double stddev) {
    const double ratio = stddev / mean;
    const double variance = natural_log(1.0 + ratio * ratio);
    return {natural_log(mean) - 0.5 * variance, std::sqrt(variance)};
}

void read_limits(TableReader& table, SizeDistribution& size, double low, double high) {
    size.low = table.number("min", k_factor, std::max(low, k_factor.low));
    size.high = table.number("max", k_factor, std::min(high, k_factor.high));
    if (!(size.low <= size.mean && size.mean <= size.high)) {
        table.fail("max", fmt::format("min {}, mean {} and max {} must rise in this order; change one", size.low,
                                      size.mean, size.high));
    }
}

void read_normal(TableReader& table, SizeDistribution& size) {
    size.law = SizeLaw::normal;
    size.mean = table.number("mean", k_factor, 1.0);
    size.stddev = table.number("stddev", {0.0, 100.0, "between 0 and 100"});
    read_limits(table, size, std::max(0.1 * size.mean, size.mean - k_tail * size.stddev),
                size.mean + k_tail * size.stddev);
}

void read_lognormal(TableReader& table, SizeDistribution& size) {
    size.law = SizeLaw::lognormal;
    size.mean = table.number("mean", k_factor, 1.0);
    size.stddev = table.number("stddev", {0.0, 100.0, "between 0 and 100"});
    const LogParameters log = log_parameters(size.mean, size.stddev);
    read_limits(table, size, exponential(log.mean - k_tail * log.stddev), exponential(log.mean + k_tail * log.stddev));
}

}  // namespace

SizeDistribution read_size(TableReader& fill) {
    SizeDistribution size;
    const toml::node* node = fill.raw("size");
    if (node == nullptr || !node->is_table()) {
        size.mean = fill.number("size", k_factor, 1.0);
        size.low = size.high = size.mean;
        return size;
    }
    const std::vector<std::string> laws = key_variants("fill.size");
    const std::string law = fill.untyped_table("size").variant("distribution", laws);
    TableReader table = fill.table("size", key_table("fill.size", law));
    table.choice("distribution", laws);
    if (law == "normal") read_normal(table, size);
    if (law == "lognormal") read_lognormal(table, size);
    if (law == "uniform") {
        size.law = SizeLaw::uniform;
        size.low = table.number("min", k_factor);
        size.high = table.number("max", k_factor);
        if (size.low > size.high) {
            table.fail("max", fmt::format("is {}, less than min = {}; swap them", size.high, size.low));
        }
    }
    fill.adopt("size", table);
    return size;
}

double draw_size(const SizeDistribution& size, RandomStream& random) {
    if (size.law == SizeLaw::fixed) return size.mean;
    constexpr int k_most_draws = 1000;
    const LogParameters log = log_parameters(size.mean, size.stddev);
    for (int k = 0; k < k_most_draws && size.law != SizeLaw::uniform; ++k) {
        const double z = random.normal();
        const double factor =
            size.law == SizeLaw::normal ? size.mean + size.stddev * z : exponential(log.mean + log.stddev * z);
        if (factor >= size.low && factor <= size.high) return factor;
    }
    // Limits so narrow that none of the draws fell between them: the density is level there.
    return random.uniform(size.low, size.high);
}

}  // namespace polargrain
