#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polargrain {

/// The keys that one kind of table takes; the one place that decides which keys there are.
struct KeyTable {
    std::string path;     ///< "run", "walls.motion", ...; "" is the top of the file
    std::string variant;  ///< the value of `type` or `distribution` where the keys depend on it
    std::vector<std::string> keys;
};

/// All tables with fixed keys, in the order of docs/scenario.md.
std::span<const KeyTable> key_tables();

/// The table of that path and variant; asking for one that is not there is a mistake of ours (std::logic_error).
const KeyTable& key_table(std::string_view path, std::string_view variant = "");

/// The variants of a path, in the order of docs/scenario.md: for "shapes" the shape types.
std::vector<std::string> key_variants(std::string_view path);

}  // namespace polargrain
