#include "scenarios/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace polargrain {

namespace {

template <typename Items, typename Text>
std::string listed(const Items& items, Text text) {
    std::string list;
    for (const auto& item : items) list += (list.empty() ? "" : ", ") + text(item);
    return "[" + list + "]";
}

std::string table_text(const toml::table& table) {
    std::string list;
    for (const auto& [key, value] : table) {
        list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", toml_key(key.str()), toml_text(value));
    }
    return list.empty() ? "{}" : "{ " + list + " }";
}

bool is_bare(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

std::string toml_text(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

std::string toml_text(std::string_view value) {
    std::string text = "\"";
    for (const char c : value) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            text += '\\';
            text += c;
        } else if (code < 0x20 || code == 0x7f) {
            text += fmt::format("\\u{:04X}", code);
        } else {
            text += c;
        }
    }
    return text + '"';
}

std::string toml_text(const Vec2& value) { return fmt::format("[{}, {}]", toml_text(value.x()), toml_text(value.y())); }

std::string toml_text(std::span<const Vec2> values) {
    return listed(values, [](const Vec2& v) { return toml_text(v); });
}

std::string toml_text(std::span<const double> values) {
    return listed(values, [](double v) { return toml_text(v); });
}

std::string toml_text(const toml::node& node) {
    if (const auto* table = node.as_table()) return table_text(*table);
    if (const auto* array = node.as_array()) return listed(*array, [](const toml::node& n) { return toml_text(n); });
    if (const auto* text = node.as_string()) return toml_text(std::string_view{text->get()});
    if (const auto* number = node.as_floating_point()) return toml_text(number->get());
    if (const auto* number = node.as_integer()) return std::to_string(number->get());
    std::ostringstream other;
    node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) other << value;
    });
    return other.str();
}

std::string toml_key(std::string_view key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
    return bare ? std::string{key} : toml_text(key);
}

bool fits_toml(std::string_view text) {
    try {
        static_cast<void>(toml::parse("text = " + toml_text(text)));
        return true;
    } catch (const toml::parse_error&) {
        return false;
    }
}

std::string kind_of(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (node.is_array()) return "an array";
    if (node.is_string()) return "a string";
    if (node.is_boolean()) return "true or false";
    if (node.is_number()) return "a number";
    return "a date or time";
}

}  // namespace polargrain
