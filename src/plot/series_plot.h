#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "src/plot/plot.h"

namespace polargrain {

/// What of a series.csv is drawn.
struct SeriesChoice {
    std::vector<std::string> columns;  ///< a panel for each; none: all, a panel for what belongs together
    double from = -std::numeric_limits<double>::infinity();  ///< [s]
    double to = std::numeric_limits<double>::infinity();     ///< [s]
};

/// The columns of a run's series.csv over time, as panels of one sheet, and what is left out.
struct SeriesPlot {
    Plot plot;
    std::vector<std::string> left_out;  ///< columns that are zero or without value throughout, unless asked for by name
};

/// Reads series.csv of docs/run-folder.md; of a run in progress, what it has so far. Without a choice of columns,
/// panels in which all values are zero are left out. InputError where the file cannot be read, has no row in that time,
/// or has no column of a name that is asked for.
SeriesPlot series_plot(const std::filesystem::path& csv, const SeriesChoice& choice, const std::string& title);

}  // namespace polargrain
