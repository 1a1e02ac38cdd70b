#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/contact_sheet.h"
#include "src/cli/commands.h"
#include "src/core/error.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// A grid a little wider than high, as frames are.
ContactSheetSettings grid_for(int count) {
    ContactSheetSettings settings;
    settings.columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(4.0 / 3.0 * count) - 1e-9)));
    settings.rows = (count + settings.columns - 1) / settings.columns;
    return settings;
}

}  // namespace

int sheet_command(const SheetRequest& request) {
    require(fs::is_directory(request.folder), "{}: no such run folder; give the folder that polargrain run has made",
            request.folder.string());
    const fs::path sheet = request.sheet.value_or(request.folder / "sheet.png");
    require(request.force || !fs::exists(sheet), "{}: is there already; give another name with -o, or --force",
            sheet.string());
    const fs::path frames = request.folder / "frames";
    if (fs::exists(frames / "000000.png")) {
        contact_sheet(frames, sheet, grid_for(request.count));
    } else {
        const TrajectoryReader recording(request.folder / "trajectory.h5");
        contact_sheet(recording, make_frame_style({}, recording.scene(), recording.title()), sheet,
                      grid_for(request.count));
    }
    fmt::print("{}\n", sheet.string());
    return k_exit_done;
}

}  // namespace polargrain
