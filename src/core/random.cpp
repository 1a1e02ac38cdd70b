#include "src/core/random.h"

#include <Random123/philox.h>

#include <cmath>

#include "src/core/elementary.h"

namespace polargrain {

RandomStream::RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t a, std::uint32_t b)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      // The last word counts blocks in its low 24 bits below the purpose: 2^25 numbers a stream.
      counter_{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32), b,
               static_cast<std::uint32_t>(purpose) << 24} {}

std::uint64_t RandomStream::bits() {
    if (left_ == 0) {
        const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
        const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
        const auto out = r123::Philox4x32{}(counter, key);
        block_ = {(std::uint64_t{out[1]} << 32) | out[0], (std::uint64_t{out[3]} << 32) | out[2]};
        left_ = 2;
        ++counter_[3];
    }
    return block_[static_cast<std::size_t>(2 - left_--)];
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double RandomStream::normal() {
    for (;;) {
        const double u = 2.0 * uniform() - 1.0;
        const double v = 2.0 * uniform() - 1.0;
        const double s = u * u + v * v;
        if (s > 0.0 && s < 1.0) return u * std::sqrt(-2.0 * natural_log(s) / s);
    }
}

}  // namespace polargrain
