#include "src/plot/plot.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "src/core/child_process.h"
#include "src/core/error.h"
#include "src/plot/gnuplot_script.h"
#include "src/record/private_folder.h"
#include "src/record/text_file.h"

namespace polargrain {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_program = "gnuplot";

void check(const Series& series) {
    const std::size_t n = series.x.size();
    const auto fits = [n](std::size_t size, bool needed) { return size == n || (size == 0 && !needed); };
    const bool arrows = series.style == SeriesStyle::arrows;
    const bool labels = series.style == SeriesStyle::labels;
    const bool cells = series.style == SeriesStyle::cells;
    require(fits(series.y.size(), true) && fits(series.y_error.size(), false) && fits(series.dx.size(), arrows) &&
                fits(series.dy.size(), arrows) && fits(series.texts.size(), labels) && fits(series.z.size(), cells),
            "series \"{}\": its columns differ in length; give every point all its numbers", series.label);
}

void check(const Plot& plot) {
    require(!plot.panels.empty() && plot.columns > 0 && plot.width > 0 && plot.height > 0,
            "plot \"{}\": has no panels or no size", plot.title);
    for (const Panel& panel : plot.panels) {
        for (const Series& series : panel.series) check(series);
    }
}

/// The number as it reads back to the same bits, or nothing.
std::string number(const std::vector<double>& column, std::size_t k) {
    return column.empty() ? std::string() : fmt::format("{}", column[k]);
}

void write_csv(const Plot& plot, const fs::path& path) {
    TextFile file(path);
    file.write("panel,series,x,y,y_error,dx,dy,text,z\n");
    for (const Panel& panel : plot.panels) {
        for (const Series& s : panel.series) {
            for (std::size_t k = 0; k < s.x.size(); ++k) {
                file.write(fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(panel.title), csv_field(s.label),
                                       s.x[k], s.y[k], number(s.y_error, k), number(s.dx, k), number(s.dy, k),
                                       s.texts.empty() ? std::string() : csv_field(s.texts[k]), number(s.z, k)));
            }
        }
        for (const Level& level : panel.levels) {
            file.write(fmt::format("{},{},{},{},,,,,\n", csv_field(panel.title), csv_field(level.label),
                                   level.vertical ? fmt::format("{}", level.value) : "",
                                   level.vertical ? "" : fmt::format("{}", level.value)));
        }
    }
    file.close();
}

std::string contents(const fs::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

fs::path with_extension(const fs::path& stem, const char* extension) {
    fs::path path = stem;
    path += extension;
    return path;
}

}  // namespace

void require_plotting() {
    if (program_on_path(k_program)) return;
    throw RunError(
        "plots are drawn with gnuplot, which is not installed or not on PATH: apt-get install gnuplot-nox (or "
        "scripts/install-packages.sh), then repeat the command");
}

void write_plot(const Plot& plot, const fs::path& stem) {
    check(plot);
    require_plotting();
    write_csv(plot, with_extension(stem, ".csv"));
    PrivateFolder folder(stem);
    const fs::path script = folder / "script.gnuplot";
    const fs::path log = folder / "log";
    TextFile file(script);
    file.write(gnuplot_script(plot, with_extension(stem, ".png"), with_extension(stem, ".pdf")));
    file.close();
    const int exit_code = ChildProcess({k_program, script.string()}, log).wait();
    if (exit_code != 0) {
        folder.keep();
        throw RunError(fmt::format("{}: gnuplot failed (exit code {}); the script is kept. It said: {}",
                                   script.string(), exit_code, contents(log)));
    }
}

}  // namespace polargrain
