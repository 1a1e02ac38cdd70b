#pragma once

#include <string>

namespace polargrain {

/// A word as a shell would need it to be typed.
std::string shell_quoted(const std::string& word);

}  // namespace polargrain
