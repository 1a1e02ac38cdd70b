#pragma once

#include <filesystem>

#include "src/record/text_file.h"
#include "src/record/trajectory_reader.h"

namespace polargrain {

/// Writes frames of a recording into grains.csv of a folder: a header row, then a row for each grain of each frame,
/// with the shortest numbers that read back to the same bits. docs/export.md lists the columns.
///
/// The file is written beside its place and put there by finish(). RunError names it where it cannot be written.
class GrainsCsv {
public:
    explicit GrainsCsv(const std::filesystem::path& folder);

    void add(const StoredFrame& frame);
    void finish();

    /// Removes what an export has left in the folder, whole or not, and nothing else.
    static void remove(const std::filesystem::path& folder);

private:
    std::filesystem::path path_, part_;
    TextFile file_;
};

}  // namespace polargrain
