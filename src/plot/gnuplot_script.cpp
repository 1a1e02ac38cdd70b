#include "src/plot/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

/// Distinguishable also for the colour-blind (Okabe and Ito's colours, darkened where thin lines need it).
constexpr std::array<const char*, 8> k_palette = {"#0072b2", "#d55e00", "#009e73", "#b5468c",
                                                  "#56a0d3", "#c78f00", "#444444", "#8c6d4f"};
/// Point symbols: filled and open circle, square, triangle, diamond.
constexpr std::array<int, 8> k_symbols = {7, 5, 9, 13, 6, 4, 7, 12};
constexpr double k_pixels_per_inch = 120.0;

/// In single quotes, where gnuplot takes everything literally.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\n' || c == '\r') {
            result += ' ';
        } else {
            result += c == '\'' ? std::string("''") : std::string(1, c);
        }
    }
    return result + "'";
}

/// In double quotes, as a field of a data block. gnuplot knows no escape for them there.
std::string field(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? '\'' : c == '\n' ? ' ' : c;
    return result + "\"";
}

std::string block_name(std::size_t panel, std::size_t series) { return fmt::format("$data_{}_{}", panel, series); }

bool is_outline(SeriesStyle style) { return style == SeriesStyle::outline || style == SeriesStyle::filled; }

std::string row(const Series& s, std::size_t k) {
    std::string text = fmt::format("{:.9g} {:.9g}", s.x[k], s.y[k]);
    if (s.style == SeriesStyle::arrows) text += fmt::format(" {:.9g} {:.9g}", s.dx[k], s.dy[k]);
    if (s.style == SeriesStyle::labels) text += " " + field(s.texts[k]);
    if (s.style == SeriesStyle::cells) text += fmt::format(" {0:.9g} {0:.9g} {1:.9g}", 0.5 * s.cell, s.z[k]);
    if (!s.y_error.empty()) text += fmt::format(" {:.9g}", s.y_error[k]);
    return text + "\n";
}

bool drawable(const Series& s, std::size_t k) { return std::isfinite(s.x[k]) && std::isfinite(s.y[k]); }

/// Empty where no point can be drawn.
std::string data_block(const Series& s, const std::string& name) {
    std::string rows, first;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
        if (!drawable(s, k)) continue;
        rows += row(s, k);
        if (first.empty()) first = rows;
    }
    if (rows.empty()) return "";
    if (is_outline(s.style)) rows += first;
    return fmt::format("{} << EOD\n{}EOD\n", name, rows);
}

const char* colour_name(int colour) { return k_palette[static_cast<std::size_t>(colour) % k_palette.size()]; }

std::string line_of(double width, int colour, bool dashed) {
    return fmt::format("lc rgb '{}' lw {} dt {}", colour_name(colour), width, dashed ? "(12,7)" : "1");
}

std::string symbol_of(int colour) {
    return fmt::format("pt {} ps 1.1", k_symbols[static_cast<std::size_t>(colour) % k_symbols.size()]);
}

std::string style_of(const Series& s, int colour) {
    const std::string line = line_of(s.width, colour, s.style == SeriesStyle::dashed);
    switch (s.style) {
        case SeriesStyle::line:
        case SeriesStyle::dashed:
        case SeriesStyle::outline: return "with lines " + line;
        case SeriesStyle::points: return "with points " + line + " " + symbol_of(colour);
        case SeriesStyle::line_points: return "with linespoints " + line + " " + symbol_of(colour);
        case SeriesStyle::steps: return "with steps " + line;
        case SeriesStyle::bars: return "with boxes fill solid 0.35 " + line;
        case SeriesStyle::filled:
            return fmt::format("with filledcurves closed fill transparent solid 0.18 border lc rgb '{0}' fc rgb '{0}'",
                               colour_name(colour));
        case SeriesStyle::arrows: return fmt::format("with vectors head filled size screen {},20 {}", s.head, line);
        case SeriesStyle::cells: return "with boxxyerror fill solid 1.0 noborder lc palette";
        case SeriesStyle::labels: return fmt::format("with labels center tc rgb '{}'", colour_name(colour));
    }
    return "with lines";
}

std::string columns_of(const Series& s) {
    switch (s.style) {
        case SeriesStyle::arrows: return "1:2:3:4";
        case SeriesStyle::labels: return "1:2:3";
        case SeriesStyle::cells: return "1:2:3:4:5";
        default: return "1:2";
    }
}

/// Marks and bars with error bars take a style of their own: error bars drawn over them would cut them out.
std::string style_with_errors(const Series& s, int colour) {
    if (s.style == SeriesStyle::bars) {
        return "with boxerrorbars fill solid 0.35 " + line_of(s.width, colour, false);
    }
    const char* with = s.style == SeriesStyle::line_points ? "with yerrorlines " : "with yerrorbars ";
    return with + line_of(s.width, colour, false) + " " + symbol_of(colour);
}

std::string plotted(const Series& s, const std::string& block, int colour) {
    const std::string title = s.label.empty() ? "notitle" : "title " + quoted(s.label);
    const bool whole =
        s.style == SeriesStyle::points || s.style == SeriesStyle::line_points || s.style == SeriesStyle::bars;
    if (!s.y_error.empty() && whole) {
        return fmt::format("{} using 1:2:3 {} {}", block, title, style_with_errors(s, colour));
    }
    std::string text = fmt::format("{} using {} {} {}", block, columns_of(s), title, style_of(s, colour));
    if (!s.y_error.empty()) {
        text += fmt::format(", {} using 1:2:3 notitle with yerrorbars {} pt 0", block,
                            line_of(0.75 * s.width, colour, false));
    }
    return text;
}

const char* key_place(KeyPlace place) {
    switch (place) {
        case KeyPlace::top_right: return "set key top right inside";
        case KeyPlace::top_left: return "set key top left inside";
        case KeyPlace::bottom_right: return "set key bottom right inside";
        case KeyPlace::bottom_left: return "set key bottom left inside";
        case KeyPlace::outside: return "set key outside right center";
        case KeyPlace::none: return "unset key";
    }
    return "unset key";
}

std::string range(const char* axis, const std::optional<std::pair<double, double>>& given, const std::string& lower) {
    return given ? fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis, given->first, given->second)
                 : fmt::format("set {}range [{}:*]\n", axis, lower);
}

/// Whether an axis that gnuplot rounds to whole ticks would go below zero, where no point does.
bool starts_at_zero(const Panel& panel, std::vector<double> Series::*values) {
    constexpr double k_next_to_zero = 0.1;  // of the largest value
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Series& s : panel.series) {
        for (std::size_t k = 0; k < s.x.size(); ++k) {
            if (!drawable(s, k)) continue;
            lowest = std::min(lowest, (s.*values)[k]);
            highest = std::max(highest, (s.*values)[k]);
        }
    }
    return lowest >= 0.0 && lowest < k_next_to_zero * highest;
}

std::string lower_end_of_x(const Panel& panel) {
    return !panel.map && !panel.log_x && starts_at_zero(panel, &Series::x) ? "0" : "*";
}

/// Bars stand on zero.
std::string lower_end_of_y(const Panel& panel) {
    const bool bars = std::any_of(panel.series.begin(), panel.series.end(),
                                  [](const Series& s) { return s.style == SeriesStyle::bars; });
    const bool zero = bars || (!panel.map && starts_at_zero(panel, &Series::y));
    return zero && !panel.log_y ? "0" : "*";
}

std::string x_ticks(const Panel& panel) {
    if (panel.x_names.empty()) return "set xtics autofreq nomirror out\n";
    std::string names;
    for (std::size_t k = 0; k < panel.x_names.size(); ++k) {
        names += fmt::format("{}{} {}", names.empty() ? "" : ", ", quoted(panel.x_names[k]), k + 1);
    }
    return fmt::format("set xtics nomirror out ({})\n", names);
}

/// Dark to light in brightness, for print: the anchors of viridis.
constexpr const char* k_scale =
    "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n";

std::string colour_scale(const Panel& panel) {
    const bool cells = std::any_of(panel.series.begin(), panel.series.end(),
                                   [](const Series& s) { return s.style == SeriesStyle::cells; });
    if (!cells) return "unset colorbox\n";
    return fmt::format("{}set colorbox\nset cbtics autofreq out\nset cblabel {}\n{}", k_scale, quoted(panel.z_label),
                       range("cb", panel.z_range, "*"));
}

std::string axes(const Panel& panel) {
    std::string text = fmt::format("set title {}\nset xlabel {}\nset ylabel {}\n{}\n", quoted(panel.title),
                                   quoted(panel.x_label), quoted(panel.y_label), key_place(panel.key));
    text += panel.log_x ? "set logscale x\n" : "unset logscale x\n";
    text += panel.log_y ? "set logscale y\n" : "unset logscale y\n";
    text += range("x", panel.x_range, lower_end_of_x(panel)) + range("y", panel.y_range, lower_end_of_y(panel));
    if (panel.map) {
        text += "set size ratio -1\nunset border\nunset tics\nunset grid\nunset key\n";
    } else {
        text += "set size noratio\nset border 3 lc rgb '#777777'\n" + x_ticks(panel) +
                "set ytics nomirror out\nset grid lc rgb '#dddddd' lt 1 lw 1\n";
    }
    return text + colour_scale(panel);
}

/// Thin lines across the panel, each with its name at its end.
std::string levels(const Panel& panel) {
    std::string text = "unset arrow\nunset label\n";
    for (const Level& level : panel.levels) {
        const std::string v = fmt::format("{:.9g}", level.value);
        const std::string from = level.vertical ? v + ", graph 0" : "graph 0, first " + v;
        const std::string to = level.vertical ? v + ", graph 1" : "graph 1, first " + v;
        const std::string at = level.vertical ? v + ", graph 0.98" : "graph 0.99, first " + v;
        text += fmt::format("set arrow from {} to {} nohead lc rgb '#777777' lw 1.2 dt (4,4) back\n", from, to);
        text += fmt::format("set label {} at {} right offset {} tc rgb '#555555' font ',11' front\n",
                            quoted(level.label), at, level.vertical ? "-0.3,-0.5 rotate by 0" : "0,0.5");
    }
    return text;
}

/// `drawn`: per series, whether it has a data block.
std::string panel_script(const Panel& panel, std::size_t p, const std::vector<bool>& drawn) {
    std::string pieces;
    int next = 0;
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const Series& series = panel.series[s];
        const int colour = series.colour ? *series.colour : next++;
        if (!drawn[s]) continue;
        pieces += (pieces.empty() ? "" : ", \\\n  ") + plotted(series, block_name(p, s), colour);
    }
    // gnuplot cannot choose ranges from nothing: an empty panel shows its axes from 0 to 1.
    if (pieces.empty()) return axes(panel) + levels(panel) + "plot [0:1] [0:1] NaN notitle\n";
    return axes(panel) + levels(panel) + "plot " + pieces + "\n";
}

}  // namespace

std::string gnuplot_script(const Plot& plot, const std::filesystem::path& png, const std::filesystem::path& pdf) {
    const std::size_t columns = std::min(plot.panels.size(), static_cast<std::size_t>(plot.columns));
    const std::size_t rows = (plot.panels.size() + columns - 1) / columns;
    std::string text = "set encoding utf8\n";
    std::string sheet = fmt::format(
        "set bars small\nset boxwidth 0.9 relative\nset offsets graph 0.02, graph 0.02, graph "
        "0.08, graph 0.02\n"
        "set multiplot layout {},{} title {} font ',16'\n",
        rows, columns, quoted(plot.title));
    for (std::size_t p = 0; p < plot.panels.size(); ++p) {
        std::vector<bool> drawn;
        for (std::size_t s = 0; s < plot.panels[p].series.size(); ++s) {
            const std::string block = data_block(plot.panels[p].series[s], block_name(p, s));
            drawn.push_back(!block.empty());
            text += block;
        }
        sheet += panel_script(plot.panels[p], p, drawn);
    }
    sheet += "unset multiplot\nunset output\n";
    text += fmt::format("set terminal pngcairo noenhanced size {},{} font 'DejaVu Sans,12' background '#ffffff'\n",
                        plot.width, plot.height);
    text += fmt::format("set output {}\n{}", quoted(png.string()), sheet);
    text += fmt::format(
        "set terminal pdfcairo noenhanced size {:.3f}in,{:.3f}in font 'DejaVu Sans,9' background '#ffffff'\n",
        plot.width / k_pixels_per_inch, plot.height / k_pixels_per_inch);
    text += fmt::format("set output {}\n{}", quoted(pdf.string()), sheet);
    return text;
}

}  // namespace polargrain
