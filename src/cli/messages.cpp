#include "src/cli/messages.h"

#include <cstdio>

namespace polargrain {

void write_message(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace polargrain
