#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace polargrain {

/// 64-bit fingerprint (XXH3) of the exact bits of numbers; equal for equal bits on every little-endian machine.
class StateHash {
public:
    void add(std::span<const double> values);
    void add(std::int64_t value);
    void add(std::string_view bytes);
    std::uint64_t value() const { return value_; }
    /// Sixteen hexadecimal digits.
    std::string hex() const;

private:
    void add_bytes(const void* data, std::size_t size);
    std::uint64_t value_ = 0;
};

}  // namespace polargrain
