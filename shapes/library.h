#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/core/vec2.h"

namespace polargrain {

/// A drawn outline as stored in a file: its points in metres as given, and where it comes from.
struct OutlineFile {
    std::string name;    ///< the file's name without .toml
    std::string title;   ///< one line for lists
    std::string source;  ///< where the outline comes from
    std::vector<Vec2> points;
    std::string file;  ///< where it was read
};

/// Reads an outline file: TOML with title, source, unit ("m", the default, "cm", "mm" or "um") and one of
///
///     points = [[x, y], ...]            in order round the grain, either way, the first not repeated
///     radii  = [r, ...]                 at equal angles, the first on the x axis
///     polar  = [[radius, degrees], ...]
///
/// InputError names file, line, column and remedy. Whether the outline is a possible grain, prepare_outline tells.
OutlineFile read_outline_file(const std::filesystem::path& path);

/// The folder of shipped outlines; InputError where it cannot be found.
///
/// Looked for as shapes/outlines in the folder that the environment variable POLARGRAIN_DATA names; if that is not
/// set, in the source tree from which the program was built, then in ../share/polargrain beside the program's folder.
std::filesystem::path shape_library_folder();

/// All shipped outlines, by name.
std::vector<OutlineFile> shape_library();

/// A file by its path (relative to `base`, or absolute), or a library entry by its bare name; a file goes first.
/// InputError names the nearest library entry where neither is there.
OutlineFile find_outline(const std::string& path_or_name, const std::filesystem::path& base);

}  // namespace polargrain
