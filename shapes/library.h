#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/core/vec2.h"

namespace polargrain {

/// A drawn outline as stored in a file: its points in metres as given, and where it comes from.
struct OutlineFile {
    std::string name;
    std::string title;   ///< one line for lists
    std::string source;  ///< where the outline comes from
    std::vector<Vec2> points;
};

/// Reads an outline file; InputError names file, line and remedy. docs/scenario.md gives the format.
OutlineFile read_outline_file(const std::filesystem::path& path);

/// The folder of shipped outlines; InputError where it cannot be found.
std::filesystem::path shape_library_folder();

/// All shipped outlines, by name.
std::vector<OutlineFile> shape_library();

/// A file by its path (relative to `base`, or absolute), or a library entry by its bare name. InputError names the
/// nearest library entry where neither is there.
OutlineFile find_outline(const std::string& path_or_name, const std::filesystem::path& base);

}  // namespace polargrain
