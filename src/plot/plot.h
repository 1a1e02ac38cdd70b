#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace polargrain {

/// How the points of a series are drawn.
enum class SeriesStyle {
    line,
    dashed,
    points,
    line_points,
    steps,    ///< a step function: each value holds until the next x
    bars,     ///< boxes from zero, for histograms
    outline,  ///< a closed polygon
    filled,   ///< a closed polygon, lightly filled
    arrows,   ///< from (x, y) by (dx, dy)
    labels,   ///< the texts, each centred at its point
    cells,    ///< squares of side `cell` about the points, coloured by z on the scale of the panel
};

/// Numbers of one kind, drawn alike.
struct Series {
    std::string label = {};  ///< in the key; empty: not in the key
    SeriesStyle style = SeriesStyle::line;
    std::vector<double> x = {}, y = {};
    std::vector<double> y_error = {};          ///< half length of error bars; empty, or one per point
    std::vector<double> dx = {}, dy = {};      ///< of arrows
    std::vector<std::string> texts = {};       ///< of labels
    std::vector<double> z = {};                ///< of cells
    double cell = 1.0;                         ///< side of cells, in the unit of the axes
    std::optional<int> colour = std::nullopt;  ///< number in the palette, from 0; none: the next in turn
    double width = 2.0;                        ///< of lines
    double head = 0.012;                       ///< length of the heads of arrows, share of the width of the sheet
};

/// A value that a quantity is held to, drawn as a thin line across the panel with its name.
struct Level {
    double value = 0.0;
    std::string label;
    bool vertical = false;  ///< at an x instead of at a y
};

enum class KeyPlace { top_right, top_left, bottom_right, bottom_left, outside, none };

/// One pair of axes.
struct Panel {
    std::string title = {};
    std::string x_label = {}, y_label = {};  ///< with the unit
    std::vector<Series> series = {};
    std::vector<Level> levels = {};
    std::vector<std::string> x_names = {};  ///< written at x = 1, 2, ... instead of numbers; empty: numbers
    /// None: as the points need it, and not below zero where all lie above.
    std::optional<std::pair<double, double>> x_range = std::nullopt, y_range = std::nullopt;
    std::string z_label = {};  ///< of the colour scale of cells, with the unit
    std::optional<std::pair<double, double>> z_range = std::nullopt;
    bool log_x = false, log_y = false;
    bool map = false;  ///< the same scale on both axes, and neither axes nor key drawn: for sketches of shapes
    KeyPlace key = KeyPlace::top_right;
};

/// Panels on one sheet.
struct Plot {
    std::string title;
    std::vector<Panel> panels = {};
    int columns = 1;
    int width = 1200;  ///< [pixel] of the PNG; the PDF has the same proportions
    int height = 800;
};

/// Throws RunError, with the remedy, where the plotting program is not installed. Ask before long work.
void require_plotting();

/// Writes stem.png, stem.pdf (vectors) and stem.csv, the numbers of all series: panel, series, x, y, then y_error or
/// dx, dy or text or z where there are any. The folder exists. Points that are not finite are left out.
///
/// Drawn with gnuplot. Texts are taken literally; letters beyond ASCII in UTF-8. InputError for a plot without panels
/// or a series whose columns differ in length, RunError where gnuplot or a file fails.
void write_plot(const Plot& plot, const std::filesystem::path& stem);

}  // namespace polargrain
