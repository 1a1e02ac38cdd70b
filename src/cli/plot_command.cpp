#include <fmt/format.h>

#include "src/cli/commands.h"
#include "src/cli/made_of_run.h"
#include "src/cli/recording.h"
#include "src/cli/run_folder.h"
#include "src/core/error.h"
#include "src/plot/series_plot.h"

namespace polargrain {

namespace fs = std::filesystem;

int plot_command(const PlotRequest& request) {
    require_run_folder(request.folder);
    const fs::path csv = request.folder / "series.csv";
    require(fs::exists(csv), "{}: has no series.csv; run it with --set output.series.every=0.01, say",
            request.folder.string());
    const fs::path stem = request.stem.value_or(plot_in(request.folder));
    for (const char* ending : k_plot_endings) {
        const fs::path file = stem.string() + ending;
        check_run_stays(request.folder, file);
        require(request.force || !fs::exists(file), "{}: is there already; give another name with -o, or --force",
                file.string());
    }
    require_plotting();
    const SeriesPlot drawn =
        series_plot(csv, request.choice, fs::absolute(request.folder).lexically_normal().filename());
    write_plot(drawn.plot, stem);
    fmt::print("{}.png, .pdf, .csv\n", stem.string());
    if (!drawn.left_out.empty()) fmt::print("zero throughout: {}\n", fmt::join(drawn.left_out, ", "));
    return k_exit_done;
}

}  // namespace polargrain
