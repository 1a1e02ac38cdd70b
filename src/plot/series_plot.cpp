#include "src/plot/series_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "src/core/error.h"
#include "src/core/nearest_name.h"
#include "src/record/csv_columns.h"
#include "src/record/sample_range.h"

namespace polargrain {

namespace {

constexpr int k_panel_width = 720;
constexpr int k_panel_height = 360;

/// Columns that are drawn in one panel, with their unit.
struct Group {
    std::string title;
    std::string unit;
    std::vector<std::string> columns;
};

/// The columns that every run has, as docs/run-folder.md explains them.
std::vector<Group> standard_groups() {
    return {
        {"kinetic energy", "J/m", {"kinetic_translational", "kinetic_rotational"}},
        {"potential energy", "J/m", {"potential"}},
        {"energy taken and given since time zero",
         "J/m",
         {"dissipated_normal", "dissipated_friction", "wall_work", "energy_correction", "energy_created",
          "energy_rises", "energy_stored"}},
        {"contacts", "", {"contacts"}},
        {"impacts since time zero", "", {"impacts"}},
        {"moves not carried out since time zero", "", {"moves_rejected", "moves_shortened"}},
        {"centre of mass", "m", {"centre_of_mass_x", "centre_of_mass_y"}},
        {"grains", "", {"grains_in", "grains_out"}},
    };
}

/// The wall of a column wall_<name><ending>; empty where it is another column.
std::string wall_of(std::string_view column, std::string_view ending) {
    constexpr std::string_view k_wall = "wall_";
    if (!column.starts_with(k_wall) || !column.ends_with(ending) || column.size() <= k_wall.size() + ending.size()) {
        return {};
    }
    return std::string(column.substr(k_wall.size(), column.size() - k_wall.size() - ending.size()));
}

/// All columns but the clock, in panels; those that are not among the standard ones have a panel each.
std::vector<Group> groups_of(const std::vector<std::string>& names) {
    std::vector<Group> groups = standard_groups();
    std::vector<std::string> known{"time", "step", "moves_tried"};
    for (const Group& group : groups) known.insert(known.end(), group.columns.begin(), group.columns.end());
    for (const std::string& name : names) {
        if (std::ranges::find(known, name) != known.end()) continue;
        const std::string wall = wall_of(name, "_fx");
        const std::string other = fmt::format("wall_{}_fy", wall);
        if (!wall.empty() && std::ranges::find(names, other) != names.end()) {
            groups.push_back({fmt::format("force on the wall {}", wall), "N/m", {name, other}});
            known.push_back(other);
        } else if (const std::string turned = wall_of(name, "_torque"); !turned.empty()) {
            groups.push_back({fmt::format("torque on the wall {}", turned), "N", {name}});
        } else {
            groups.push_back({name, "", {name}});
        }
    }
    return groups;
}

bool is_nothing(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double v) { return v == 0.0 || !std::isfinite(v); });
}

/// The columns by name, cut to the time that is asked for.
struct Recorded {
    CsvColumns csv;
    SampleRange rows;

    std::vector<double> column(const std::string& name) const {
        const auto found = csv.values.find(name);
        if (found == csv.values.end()) return {};
        const auto begin = found->second.begin();
        return {begin + static_cast<std::ptrdiff_t>(rows.first), begin + static_cast<std::ptrdiff_t>(rows.last)};
    }
};

/// [s]; zero where the rows do not tell.
double time_step_of(const CsvColumns& csv) {
    const auto step = csv.values.find("step");
    if (step == csv.values.end() || step->second.empty()) return 0.0;
    const std::vector<double>& time = csv.values.at("time");
    const double steps = step->second.back() - step->second.front();
    return steps > 0.0 ? (time.back() - time.front()) / steps : 0.0;
}

Recorded read(const std::filesystem::path& path, const SeriesChoice& choice) {
    Recorded recorded{read_columns(path), {}};
    const auto time = recorded.csv.values.find("time");
    require(time != recorded.csv.values.end(), "{}: has no column time; give the series.csv of a run", path.string());
    const std::vector<double>& t = time->second;
    recorded.rows = samples_between(t, choice.from, choice.to, time_step_of(recorded.csv));
    require(!t.empty(), "{}: has no row yet", path.string());
    require(recorded.rows.first < recorded.rows.last, "{}: has no row from {} to {} s; it has {} to {} s",
            path.string(), choice.from, choice.to, t.front(), t.back());
    for (const std::string& name : choice.columns) {
        if (recorded.csv.values.contains(name)) continue;
        const std::string near = nearest_name(name, recorded.csv.names);
        throw InputError(fmt::format("{}: has no column {}; {}it has {}", path.string(), name,
                                     near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near),
                                     fmt::join(recorded.csv.names, ", ")));
    }
    return recorded;
}

}  // namespace

SeriesPlot series_plot(const std::filesystem::path& csv, const SeriesChoice& choice, const std::string& title) {
    const Recorded recorded = read(csv, choice);
    std::vector<Group> groups;
    if (choice.columns.empty()) {
        groups = groups_of(recorded.csv.names);
    } else {
        for (const std::string& name : choice.columns) groups.push_back({name, "", {name}});
    }
    SeriesPlot result;
    Plot& plot = result.plot;
    plot.title = title;
    const std::vector<double> time = recorded.column("time");
    for (const Group& group : groups) {
        Panel panel;
        panel.title = group.title;
        panel.x_label = "time [s]";
        panel.y_label = group.unit.empty() ? "" : fmt::format("[{}]", group.unit);
        for (const std::string& name : group.columns) {
            Series series;
            series.label = name;
            series.y = recorded.column(name);
            if (series.y.empty()) continue;
            if (choice.columns.empty() && is_nothing(series.y)) {
                result.left_out.push_back(name);
                continue;
            }
            series.x = time;
            panel.series.push_back(std::move(series));
        }
        panel.key = panel.series.size() == 1 ? KeyPlace::none : KeyPlace::outside;
        if (time.front() < time.back()) panel.x_range = {time.front(), time.back()};
        if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
    }
    require(!plot.panels.empty(), "{}: all of its columns are zero throughout; there is nothing to draw", csv.string());
    plot.columns = plot.panels.size() > 1 ? 2 : 1;
    const int rows = (static_cast<int>(plot.panels.size()) + plot.columns - 1) / plot.columns;
    plot.width = plot.columns * k_panel_width;
    plot.height = rows * k_panel_height;
    return result;
}

}  // namespace polargrain
