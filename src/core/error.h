#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace polargrain {

/// Where in a file a value stands; line and column count from 1, 0 means unknown.
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;
};

/// The user's mistake: always on, ends the program with exit code 2.
///
/// The message says what is wrong and what to do about it; the constructor with a place puts file, line and column in
/// front.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    InputError(const SourceLocation& where, const std::string& message);
};

/// A run that cannot go on (a full disk, a lost folder): exit code 1.
class RunError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// "file:line:column", leaving out what is unknown.
std::string to_string(const SourceLocation& where);

/// Throws InputError with the formatted message unless the condition holds.
template <typename... Args>
void require(bool condition, fmt::format_string<Args...> message, Args&&... args) {
    if (!condition) throw InputError(fmt::format(message, std::forward<Args>(args)...));
}

/// Our own mistake: prints the values and where, then throws std::logic_error. Always on; keep it out of inner loops.
[[noreturn]] void broken_invariant(const char* expression, const char* file, int line, const std::string& values);

}  // namespace polargrain

/// PG_ASSERT(condition, "a {} b {}", a, b): an invariant of ours; checked in builds with POLARGRAIN_ASSERTS.
#ifdef POLARGRAIN_ASSERTS
#define PG_ASSERT(condition, ...)                                                                                   \
    do {                                                                                                            \
        if (!(condition)) ::polargrain::broken_invariant(#condition, __FILE__, __LINE__, fmt::format(__VA_ARGS__)); \
    } while (false)
#else
#define PG_ASSERT(condition, ...) static_cast<void>(0)
#endif
