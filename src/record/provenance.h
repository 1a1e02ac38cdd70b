#pragma once

#include <string>

namespace polargrain {

/// Who and what made a file. The program fills it; nothing here is found out behind its back, so that equal runs
/// write equal bytes.
struct Provenance {
    std::string version = "unknown";  ///< of the program
    std::string build;                ///< compiler, flags and library versions, in a line
    std::string author = "unknown";   ///< who ran it (H5MD wants a name)
};

}  // namespace polargrain
