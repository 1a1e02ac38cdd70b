#pragma once

#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>

#include "src/core/vec2.h"

namespace polargrain {

// Values as TOML text on one line. Numbers are as short as can be and read back to the same bits.

std::string toml_text(double value);
std::string toml_text(std::string_view value);
std::string toml_text(const Vec2& value);
std::string toml_text(std::span<const Vec2> values);
std::string toml_text(std::span<const double> values);
std::string toml_text(const toml::node& node);

/// A key, in quotes where it needs them.
std::string toml_key(std::string_view key);

/// Whether the text can stand in TOML, in quotes: it cannot where it is not UTF-8.
bool fits_toml(std::string_view text);

/// "a number", "a string", ... for messages.
std::string kind_of(const toml::node& node);

}  // namespace polargrain
