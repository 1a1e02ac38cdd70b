#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "src/cli/commands.h"
#include "src/cli/made_of_run.h"
#include "src/cli/recording.h"
#include "src/cli/run_folder.h"
#include "src/core/error.h"
#include "src/export/grains_csv.h"
#include "src/export/vtk_export.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

bool asks_for(const ExportRequest& request, const char* format) {
    return std::ranges::find(request.formats, format) != request.formats.end();
}

void check_export_folder(const fs::path& folder, bool force) {
    check_place(folder);
    require(force || !fs::exists(folder) || fs::is_empty(folder),
            "{}: is there already; give another name with -o, or --force to replace the export in it", folder.string());
}

}  // namespace

int export_command(const ExportRequest& request) {
    const TrajectoryReader recording = open_recording(request.folder);
    const std::vector<int> frames = chosen_frames(request.frames, recording, request.folder);
    const fs::path place = request.out.value_or(export_in(request.folder));
    const FolderLock lock = claim_folder(place, [&] { check_export_folder(place, request.force); });
    VtkExport::remove(place);
    GrainsCsv::remove(place);
    std::optional<VtkExport> vtk;
    if (asks_for(request, k_vtk)) vtk.emplace(place, recording, request.disk_sides);
    std::optional<GrainsCsv> csv;
    if (asks_for(request, k_csv)) csv.emplace(place);
    for_each_frame(recording, frames, "exporting", request.quiet, [&](const StoredFrame& frame) {
        if (vtk) vtk->add(frame);
        if (csv) csv->add(frame);
    });
    if (vtk) vtk->finish();
    if (csv) csv->finish();
    if (!request.quiet) fmt::print("{} frames: {}\n", frames.size(), place.string());
    return k_exit_done;
}

}  // namespace polargrain
