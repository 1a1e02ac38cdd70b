#pragma once

#include <span>
#include <string>

namespace polargrain {

/// Mean of a few values and how they scatter; values that are no numbers are left out.
struct Spread {
    int count = 0;
    double mean = 0.0;       ///< NaN for no values
    double deviation = 0.0;  ///< standard deviation of the population that they are a sample of; 0 for one value
};

Spread spread_of(std::span<const double> values);

enum class Agreement {
    same,           ///< to a thousandth, or both zero
    within_spread,  ///< the means do not differ significantly
    differs,
    single,   ///< they differ, but one value says nothing of the spread
    unknown,  ///< no values on one side
};

/// How the mean of one sample stands to that of another.
struct Verdict {
    Agreement agreement = Agreement::unknown;
    double difference = 0.0;  ///< other less reference
    double relative = 0.0;    ///< the same over the magnitude of the reference; infinite where that is zero
};

/// Welch's test of two means at the level of 5 %, for samples of unlike spread. [W47]
Verdict compare_means(const Spread& reference, const Spread& other);

/// "agrees within the spread (+1.2 %)", "differs by -0.013 m (-12 %)", ...
std::string to_string(const Verdict& verdict, const std::string& unit);

/// A number with its spread, "1.23 +- 0.04", to the digits that the spread leaves; without spread four digits.
std::string to_string(const Spread& spread);

}  // namespace polargrain
