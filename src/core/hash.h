#pragma once

#include <cstdint>
#include <memory>
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

/// 64-bit fingerprint (XXH3) of a text, the same into whatever pieces it is cut.
class TextHash {
public:
    TextHash();
    ~TextHash();
    TextHash(TextHash&& other) noexcept;
    TextHash& operator=(TextHash&& other) noexcept;
    TextHash(const TextHash&) = delete;
    TextHash& operator=(const TextHash&) = delete;

    void add(std::string_view text);
    /// Of all that has been added so far.
    std::uint64_t value() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace polargrain
