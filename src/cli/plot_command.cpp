#include <fmt/format.h>

#include "src/cli/commands.h"
#include "src/cli/made_of_run.h"
#include "src/cli/recording.h"
#include "src/cli/run_folder.h"
#include "src/core/error.h"
#include "src/plot/series_plot.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

/// "d/", "." and ".." would become the hidden files d/.png, ..png and ...png.
void require_name(const fs::path& stem) {
    const fs::path name = stem.filename();
    require(!name.empty() && name != "." && name != "..",
            "-o {}: is a folder; give the files a name in it, without ending: -o {}", stem.string(),
            (stem / "plot").string());
}

}  // namespace

int plot_command(const PlotRequest& request) {
    require_run_folder(request.folder);
    const fs::path csv = request.folder / "series.csv";
    require(fs::exists(csv), "{}: has no series.csv; run it with --set output.series.every=0.01, say",
            request.folder.string());
    const fs::path stem = request.stem.value_or(plot_in(request.folder));
    require_name(stem);
    for (const char* ending : k_plot_endings) {
        const fs::path file = stem.string() + ending;
        check_run_stays(request.folder, file);
        require(request.force || !fs::exists(file), "{}: is there already; give another name with -o, or --force",
                file.string());
    }
    require_plotting();
    const SeriesPlot drawn =
        series_plot(csv, request.choice, fs::absolute(request.folder).lexically_normal().filename());
    make_folder_of(stem);
    write_plot(drawn.plot, stem);
    fmt::print("{}.png, .pdf, .csv\n", stem.string());
    if (!drawn.left_out.empty()) fmt::print("zero throughout: {}\n", fmt::join(drawn.left_out, ", "));
    return k_exit_done;
}

}  // namespace polargrain
