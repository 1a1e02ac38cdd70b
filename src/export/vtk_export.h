#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "src/export/frame_data.h"
#include "src/export/vtp.h"
#include "src/record/trajectory_reader.h"

namespace polargrain {

/// Writes frames of a recording into a folder for ParaView: grains.pvd, contacts.pvd and walls.pvd, and beside each a
/// folder of its name with a file for each frame, 000000.vtp, 000001.vtp, ...
///
/// The .pvd files come last, each whole or not at all: where they are, so are all of the files that they name. RunError
/// names a file that cannot be written.
class VtkExport {
public:
    /// The recording outlives it. disk_sides: as in outline_cells.
    VtkExport(std::filesystem::path folder, const TrajectoryReader& recording, int disk_sides);

    void add(const StoredFrame& frame);
    void finish();

    /// Removes what an export has left in the folder, whole or not, and nothing else; the .pvd files first.
    static void remove(const std::filesystem::path& folder);

private:
    void write(std::size_t series, const PolyData& data, double time);

    std::filesystem::path folder_;
    const TrajectoryReader& recording_;
    GrainCells grains_;
    std::array<std::vector<TimedFile>, 3> files_;  // of each series
};

}  // namespace polargrain
