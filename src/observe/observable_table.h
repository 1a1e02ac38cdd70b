#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/observe/units.h"

namespace polargrain {

/// What narrows an observable down, as bits; the names are those of the keys in scenario files.
enum ParameterBits : std::uint8_t {
    k_region = 1,
    k_kind = 2,  ///< shape, material, started_in: which grains
    k_opening = 4,
    k_wall = 8,
    k_cell = 16,
};

/// An observable as people know it.
struct ObservableEntry {
    std::string name;
    Dimension dimension = Dimension::number;
    std::uint8_t needs = 0;  ///< ParameterBits that must be given
    std::uint8_t takes = 0;  ///< ParameterBits that may be given, beside those
    bool standard = false;   ///< asks for nothing and stands in every summary
    std::string line;        ///< what it is, for lists
};

/// Every observable, grouped as in docs/observables.md: the one place that decides which there are.
std::span<const ObservableEntry> observable_table();

/// By its name; null where there is none.
const ObservableEntry* find_observable(std::string_view name);

std::vector<std::string> observable_names();

/// Names of the keys of some parameters: "region", "shape", "material", ...
std::vector<std::string> parameter_keys(std::uint8_t parameters);

}  // namespace polargrain
