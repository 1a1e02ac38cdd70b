#pragma once

#include "scenarios/table_reader.h"
#include "src/core/random.h"

namespace polargrain {

enum class SizeLaw { fixed, uniform, normal, lognormal };

/// How the factor on a shape's size varies from grain to grain.
struct SizeDistribution {
    SizeLaw law = SizeLaw::fixed;
    double mean = 1.0, stddev = 0.0;  ///< of the factor itself, also for lognormal; unused where uniform
    double low = 1.0, high = 1.0;     ///< truncation: a draw outside is drawn again
};

/// A plain number, or a table with its distribution; 1 where the key is missing.
SizeDistribution read_size(TableReader& fill);

double draw_size(const SizeDistribution& size, RandomStream& random);

}  // namespace polargrain
