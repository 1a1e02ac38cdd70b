#include <fmt/format.h>

#include "render/contact_sheet.h"
#include "src/cli/commands.h"
#include "src/cli/made_of_run.h"
#include "src/cli/recording.h"
#include "src/cli/run_folder.h"
#include "src/core/error.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

int sheet_command(const SheetRequest& request) {
    require_run_folder(request.folder);
    const fs::path sheet = request.sheet.value_or(sheet_in(request.folder));
    check_run_stays(request.folder, sheet);
    require(request.force || !fs::exists(sheet), "{}: is there already; give another name with -o, or --force",
            sheet.string());
    ContactSheetSettings settings;
    settings.count = request.count;
    const fs::path frames = request.folder / "frames";
    if (fs::exists(frames / "000000.png")) {
        make_folder_of(sheet);
        contact_sheet(frames, sheet, settings);
    } else {
        const TrajectoryReader recording = open_recording(request.folder);
        make_folder_of(sheet);
        contact_sheet(recording, make_frame_style({}, recording.scene(), recording.title()), sheet, settings);
    }
    fmt::print("{}\n", sheet.string());
    return k_exit_done;
}

}  // namespace polargrain
