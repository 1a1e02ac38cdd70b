#include "src/core/error.h"

namespace polargrain {

std::string to_string(const SourceLocation& where) {
    std::string text = where.file;
    if (where.line > 0) text += fmt::format(":{}", where.line);
    if (where.line > 0 && where.column > 0) text += fmt::format(":{}", where.column);
    return text;
}

InputError::InputError(const SourceLocation& where, const std::string& message)
    : std::runtime_error(where.file.empty() ? message : to_string(where) + ": " + message) {}

void broken_invariant(const char* expression, const char* file, int line, const std::string& values) {
    throw std::logic_error(fmt::format("{}:{}: broken invariant: {} ({})", file, line, expression, values));
}

}  // namespace polargrain
