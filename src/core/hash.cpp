#include "src/core/hash.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace polargrain {

void StateHash::add_bytes(const void* data, std::size_t size) { value_ = XXH3_64bits_withSeed(data, size, value_); }

void StateHash::add(std::span<const double> values) { add_bytes(values.data(), values.size_bytes()); }

void StateHash::add(std::int64_t value) { add_bytes(&value, sizeof value); }

void StateHash::add(std::string_view bytes) { add_bytes(bytes.data(), bytes.size()); }

std::string StateHash::hex() const { return fmt::format("{:016x}", value_); }

struct TextHash::State {
    XXH3_state_t of_library;
};

TextHash::TextHash() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->of_library); }

TextHash::~TextHash() = default;
TextHash::TextHash(TextHash&& other) noexcept = default;
TextHash& TextHash::operator=(TextHash&& other) noexcept = default;

void TextHash::add(std::string_view text) { XXH3_64bits_update(&state_->of_library, text.data(), text.size()); }

std::uint64_t TextHash::value() const { return XXH3_64bits_digest(&state_->of_library); }

}  // namespace polargrain
