#pragma once

#include <array>
#include <cstdint>

namespace polargrain {

/// What a random number is for; part of the counter, so that no two uses ever share a stream.
enum class RandomPurpose : std::uint32_t { fill = 1, rough_shape = 2, restitution = 3, test = 4, jitter = 5 };

/// Counter-based random numbers (Philox 4x32-10, Random123).
///
/// A stream is named by (seed, purpose, a, b): the n-th number of a stream is a pure function of the name and
/// of n, so that draws depend neither on threads nor on the order in which streams are used.
class RandomStream {
public:
    RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t a = 0, std::uint32_t b = 0);

    /// Uniform in [0, 1), 53 bits.
    double uniform();
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Standard normal (polar method; same bits on every machine).
    double normal();

    /// Uniform 64-bit word.
    std::uint64_t bits();

private:
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint64_t, 2> block_{};
    int left_ = 0;
};

}  // namespace polargrain
