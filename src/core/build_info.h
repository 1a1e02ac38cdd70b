#pragma once

#include <string>

namespace polargrain {

/// What this program was built from and how; for provenance in files and for --version.
struct BuildInfo {
    std::string version;    ///< "0.1.0"
    std::string compiler;   ///< "GNU 12.2.0"
    std::string flags;      ///< "Release -O2 -DNDEBUG -std=c++20 -ffp-contract=off"
    std::string libraries;  ///< "Eigen 3.4.0, CGAL 5.5.1, ..."
};

const BuildInfo& build_info();

}  // namespace polargrain
