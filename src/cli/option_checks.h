#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace polargrain {

/// What is wrong with the word after an option, nothing where it will do. For CLI::Option::check.
using OptionCheck = std::function<std::string(const std::string& word)>;

/// noun: as in "0 is no number of threads".
OptionCheck whole_number(std::string noun, std::int64_t from, std::int64_t to);

/// A number that is one: neither nan nor infinite.
OptionCheck any_number(std::string noun);
OptionCheck number_above_zero(std::string noun);
OptionCheck number_between(std::string noun, double from, double to);

}  // namespace polargrain
