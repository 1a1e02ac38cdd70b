#include "render/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "render/layout.h"
#include "render/painting.h"
#include "src/core/error.h"

namespace polargrain {

namespace {

/// Which of n things to show in so many places, evenly from the first to the last.
std::vector<int> spread(int n, int places) {
    const int shown = std::min(n, places);
    std::vector<int> chosen;
    chosen.reserve(static_cast<std::size_t>(shown));
    for (int k = 0; k < shown; ++k) {
        chosen.push_back(shown == 1 ? 0 : static_cast<int>((2L * k * (n - 1) + shown - 1) / (2L * (shown - 1))));
    }
    return chosen;
}

/// A grid of equal cells under a header strip and over a footer strip.
struct Grid {
    int columns = 1;
    int rows = 1;
    double gap = 0.0, header = 0.0, footer = 0.0;
    double cell_width = 0.0, cell_height = 0.0;

    int width() const { return even(gap + columns * (cell_width + gap)); }
    int height() const { return even(header + gap + rows * (cell_height + gap) + footer); }
    Rect cell(int k) const {
        const int row = k / columns, column = k % columns;
        return {gap + column * (cell_width + gap), header + gap + row * (cell_height + gap), cell_width, cell_height};
    }

private:
    static int even(double pixels) { return 2 * static_cast<int>(std::ceil(0.5 * pixels - 1e-9)); }
};

/// How far a grid is from a sheet 3/4 as high as wide without empty places; aspect: height of a cell over its width.
double misfit(int cells, int columns, double aspect) {
    const int rows = (cells + columns - 1) / columns;
    const double shape = rows * aspect / (columns * 0.75);
    const double empty = static_cast<double>(rows * columns - cells) / cells;
    return std::abs(std::log(shape)) + 2.0 * empty;
}

int fitting_columns(int cells, double aspect) {
    int best = 1;
    for (int columns = 2; columns <= cells; ++columns) {
        if (misfit(cells, columns, aspect) < misfit(cells, best, aspect)) best = columns;
    }
    return best;
}

Grid grid_for(int cells, double aspect, const ContactSheetSettings& settings) {
    Grid grid;
    cells = std::max(1, cells);
    grid.columns = settings.columns > 0 ? std::min(settings.columns, cells) : fitting_columns(cells, aspect);
    grid.rows = (cells + grid.columns - 1) / grid.columns;
    grid.gap = std::floor(0.008 * settings.width);
    grid.cell_width = std::floor((settings.width - grid.gap) / static_cast<double>(grid.columns) - grid.gap);
    grid.cell_height = std::floor(aspect * grid.cell_width);
    return grid;
}

struct IndexRow {
    std::filesystem::path file;
    double time = 0.0;
};

/// The rows of the index.csv that FramesSink writes.
std::vector<IndexRow> read_index(const std::filesystem::path& folder) {
    std::ifstream index(folder / "index.csv");
    require(index.good(), "{}: no such file; give the frames/ folder of a run", (folder / "index.csv").string());
    std::vector<IndexRow> rows;
    std::string line;
    std::getline(index, line);
    while (std::getline(index, line)) {
        const std::size_t comma = line.find(',');
        if (comma == std::string::npos) break;  // a row cut short by a kill
        IndexRow row{folder / line.substr(0, comma)};
        std::from_chars(line.data() + comma + 1, line.data() + line.size(), row.time);
        rows.push_back(std::move(row));
    }
    require(!rows.empty() && rows.front().file.extension() == ".png",
            "{}: holds no PNG frames; a contact sheet is put together from those", folder.string());
    return rows;
}

void label(cairo_t* cr, const Rect& cell, double letter, const std::string& text) {
    choose_font(cr, letter);
    const Rect plate{cell.x + 0.4 * letter, cell.y + 0.4 * letter, text_width(cr, text) + 0.8 * letter, 1.5 * letter};
    cairo_rectangle(cr, plate.x, plate.y, plate.width, plate.height);
    cairo_set_source_rgba(cr, 1.0, 1.0, 1.0, 0.85);
    cairo_fill(cr);
    set_colour(cr, k_ink);
    draw_text(cr, plate.x + 0.4 * letter, plate.y + 1.1 * letter, text, Align::left);
}

}  // namespace

void contact_sheet(const std::filesystem::path& frames_folder, const std::filesystem::path& sheet,
                   const ContactSheetSettings& settings) {
    const std::vector<IndexRow> rows = read_index(frames_folder);
    const std::vector<int> chosen = spread(static_cast<int>(rows.size()), settings.count);
    const Image first(rows.front().file);
    const Grid grid = grid_for(static_cast<int>(chosen.size()), first.height() / first.width(), settings);
    Canvas canvas(sheet, grid.width(), grid.height());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const Rect cell = grid.cell(static_cast<int>(k));
        Image(rows[static_cast<std::size_t>(chosen[k])].file).draw(canvas.context(), cell);
        cairo_rectangle(canvas.context(), cell.x, cell.y, cell.width, cell.height);
        set_colour(canvas.context(), {0.80, 0.82, 0.84});
        cairo_set_line_width(canvas.context(), 1.0);
        cairo_stroke(canvas.context());
    }
    canvas.finish();
}

void contact_sheet(const TrajectoryReader& recording, const FrameStyle& style, const std::filesystem::path& sheet,
                   const ContactSheetSettings& settings) {
    std::vector<LabelledFrame> cells;
    for (const int f : spread(recording.frames(), settings.count)) {
        cells.push_back({f, time_text(recording.frame(f).world.time, style.time_decimals)});
    }
    contact_sheet(recording, cells, style, sheet, settings);
}

void contact_sheet(const TrajectoryReader& recording, const std::vector<LabelledFrame>& cells, const FrameStyle& style,
                   const std::filesystem::path& sheet, const ContactSheetSettings& settings) {
    const double aspect = std::clamp(style.view.height() / style.view.width(), 0.1, 2.0);
    Grid grid = grid_for(static_cast<int>(cells.size()), aspect, settings);
    const double letter = letter_height(0.8 * grid.width());
    grid.header = 2.0 * letter;
    grid.footer = 2.7 * letter;
    Canvas canvas(sheet, grid.width(), grid.height());
    cairo_t* cr = canvas.context();
    const Rect paper = canvas.sheet();
    const double inner = paper.width - 2.0 * grid.gap;
    draw_header(cr, {grid.gap, 0.0, inner, grid.header + 0.4 * letter}, letter, style.title, std::nullopt);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const StoredFrame frame = recording.frame(cells[k].frame);
        const Rect cell = grid.cell(static_cast<int>(k));
        const double cell_letter = std::max(11.0, letter_height(2.2 * cell.width));
        draw_plot(cr, picture_of(recording.scene(), frame), style, cell, cell_letter);
        label(cr, cell, cell_letter, cells[k].label);
    }
    const Rect footer{grid.gap, paper.height - grid.footer - 0.4 * letter, inner, grid.footer};
    const double scale = Projection(style.view, grid.cell(0)).scale();
    draw_legend(cr, footer, letter, style, recording.scene(), scale);
    draw_scale_bar(cr, footer, letter, scale);
    canvas.finish();
}

}  // namespace polargrain
