#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace polargrain {

/// Writes to standard error. Where that fails nobody can be told, and nothing is stopped for it.
void write_message(std::string_view text);

/// The same with values.
template <typename... Args>
void tell(fmt::format_string<Args...> message, Args&&... args) {
    write_message(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace polargrain
