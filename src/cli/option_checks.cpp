#include "src/cli/option_checks.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace polargrain {

namespace {

template <typename T>
std::optional<T> parsed(const std::string& word) {
    T value{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc{} || stop != end) return {};
    return value;
}

/// range: what to give instead.
template <typename Fits>
OptionCheck number_that(std::string noun, std::string range, Fits fits) {
    return [noun = std::move(noun), range = std::move(range), fits](const std::string& word) -> std::string {
        const std::optional<double> value = parsed<double>(word);
        if (value && std::isfinite(*value) && fits(*value)) return "";
        return fmt::format("{} is no {}; give a number{}", word, noun, range);
    };
}

}  // namespace

OptionCheck whole_number(std::string noun, std::int64_t from, std::int64_t to) {
    return [noun = std::move(noun), from, to](const std::string& word) -> std::string {
        const std::optional<std::int64_t> value = parsed<std::int64_t>(word);
        if (value && *value >= from && *value <= to) return "";
        return fmt::format("{} is no {}; give a whole number from {} to {}", word, noun, from, to);
    };
}

OptionCheck any_number(std::string noun) {
    return number_that(std::move(noun), "", [](double) { return true; });
}

OptionCheck number_above_zero(std::string noun) {
    return number_that(std::move(noun), " above 0", [](double value) { return value > 0.0; });
}

OptionCheck number_between(std::string noun, double from, double to) {
    return number_that(std::move(noun), fmt::format(" from {:g} to {:g}", from, to),
                       [from, to](double value) { return value >= from && value <= to; });
}

}  // namespace polargrain
