#pragma once

#include <filesystem>
#include <string>

#include "src/model/checkpoint.h"

namespace polargrain {

/// What must fit before the arrays of a checkpoint mean anything.
struct CheckpointLabel {
    std::string version;   ///< of the program that began the run
    std::string build;     ///< its compiler, flags and library versions
    std::string engine;    ///< of the run
    std::string scenario;  ///< fingerprint of the scenario as run
};

struct LabelledCheckpoint {
    CheckpointLabel label;
    Checkpoint content;
};

/// Writes a checkpoint: beside its place first, and renamed when it is on the disk, so that a kill at any instant
/// leaves the last good one. RunError names the file; the one that was there stays then.
///
/// An HDF5 file behind 512 bytes of text with format version, length and checksum (XXH3) of what follows;
/// docs/run-folder.md gives the layout.
void write_checkpoint(const std::filesystem::path& path, const LabelledCheckpoint& checkpoint);

/// Whether the file begins as a checkpoint does; what follows may be damaged.
bool is_checkpoint(const std::filesystem::path& path);

/// Reads one back, with all its bits. InputError where it is absent, damaged, cut short, foreign, or of a format that
/// this program does not know.
LabelledCheckpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace polargrain
