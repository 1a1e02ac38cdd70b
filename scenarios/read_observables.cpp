#include <algorithm>
#include <cmath>
#include <set>

#include "scenarios/sections.h"
#include "scenarios/toml_text.h"
#include "src/observe/observer.h"
#include "src/observe/reduction.h"
#include "src/observe/series_columns.h"

namespace polargrain {

namespace {

constexpr NumberRange k_time{0.0, 1e6, "a number of seconds (0 to 1e6)"};

std::optional<std::vector<Vec2>> read_two_points(TableReader& table, const std::string& key) {
    if (table.raw(key) == nullptr) return {};
    std::vector<Vec2> points = table.points(key, 2);
    if (points.size() != 2)
        table.fail(key, fmt::format("has {} points, must have two; leave out the rest", points.size()));
    return points;
}

std::optional<Region> read_region(TableReader& table, const std::string& key) {
    const auto corners = read_two_points(table, key);
    if (!corners) return {};
    if (!(((*corners)[1] - (*corners)[0]).minCoeff() > 0.0)) {
        table.fail(key,
                   "must be the lower left and the upper right corner, [[x0, y0], [x1, y1]] with x1 > x0, y1 > y0");
    }
    return Region{(*corners)[0], (*corners)[1]};
}

std::optional<Opening> read_opening(TableReader& table) {
    const auto ends = read_two_points(table, "opening");
    if (!ends) return {};
    if (!(((*ends)[1] - (*ends)[0]).squaredNorm() > 0.0)) {
        table.fail("opening", "its two ends coincide; give the ends of the gap, [[x0, y0], [x1, y1]]");
    }
    return Opening{(*ends)[0], (*ends)[1]};
}

std::optional<std::string> read_name(TableReader& table, const std::string& key) {
    if (table.raw(key) == nullptr) return {};
    return table.text(key);
}

/// What [[expect]] and the entries of output.observe have in common.
ObservableSpec read_spec(const Scene& scene, TableReader& table) {
    static const std::vector<std::string> names = observable_names();
    ObservableSpec spec;
    spec.quantity = table.choice("quantity", names);
    if (const auto label = read_name(table, "label")) {
        if (!is_plain_name(*label)) {
            table.fail("label", fmt::format("\"{}\": a label is made of letters, digits, _ and -; change it", *label));
        }
        spec.label = *label;
    }
    spec.region = read_region(table, "region");
    spec.started_in = read_region(table, "started_in");
    spec.opening = read_opening(table);
    spec.wall = read_name(table, "wall");
    spec.shape = read_name(table, "shape");
    spec.material = read_name(table, "material");
    spec.cell = table.optional_number("cell", k_positive);
    try {
        check_observable(spec, scene);
    } catch (const InputError& error) {
        throw InputError(table.where(), fmt::format("{}: {}", table.path(), error.what()));
    }
    return spec;
}

Statistic read_statistic(TableReader& table) {
    const std::vector<std::string>& names = statistic_names();
    const std::string name = table.choice("statistic", names, names.front());
    return static_cast<Statistic>(std::find(names.begin(), names.end(), name) - names.begin());
}

void read_window(TableReader& table, Expectation& expectation) {
    expectation.from = table.optional_number("from", k_time);
    expectation.to = table.optional_number("to", k_time);
    if (expectation.to && expectation.from.value_or(0.0) > *expectation.to) {
        table.fail("to", fmt::format("is {}, before from = {}; swap them", *expectation.to, *expectation.from));
    }
}

void read_band(TableReader& table, Expectation& expectation) {
    expectation.min = table.optional_number("min", k_any_number);
    expectation.max = table.optional_number("max", k_any_number);
    if (!expectation.min && !expectation.max) {
        throw InputError(table.where(), table.path() + ": has neither min nor max; give one of them, or both");
    }
    if (expectation.min && expectation.max && *expectation.min > *expectation.max) {
        table.fail("max", fmt::format("is {}, less than min = {}; swap them", *expectation.max, *expectation.min));
    }
}

std::string read_unit(TableReader& table, const Scene& scene, const ObservableSpec& spec) {
    const Dimension dimension = find_observable(spec.quantity)->dimension;
    std::string unit = table.text("unit", "");
    const auto scale = unit_scale(dimension, unit, scene);
    if (!scale) {
        table.fail("unit", fmt::format(R"("{}" is no unit of {}; give one of "{}")", unit, spec.quantity,
                                       fmt::join(units_of(dimension), "\", \"")));
    }
    if (!(*scale > 0.0 && std::isfinite(*scale))) {
        table.fail("unit", fmt::format(R"("{}" is zero in this scene, which has no gravity; give "{}")", unit,
                                       units_of(dimension).front()));
    }
    return unit;
}

/// One entry of output.observe; adds its text to the resolved list.
ObservableSpec read_observed(Reading& reading, const TableReader& output, const toml::node& element,
                             const std::string& path, std::string& resolved) {
    // A bare name stands for a table with nothing but the quantity.
    toml::table named;
    const toml::table* entry = element.as_table();
    if (const auto name = element.value<std::string>()) {
        named.insert("quantity", *name);
        entry = &named;
    }
    if (entry == nullptr) {
        output.fail("observe",
                    fmt::format("{} is {}, must be a name or a table with a quantity", path, kind_of(element)));
    }
    TableReader table(reading.document, {"", path, entry, output.where("observe")}, key_table("output.observe"));
    ObservableSpec spec = read_spec(reading.scenario.scene, table);
    if (spec.label.empty()) spec.label = spec.quantity;
    table.finish();
    resolved += (resolved.empty() ? "" : ", ") + table.resolved_inline();
    return spec;
}

}  // namespace

std::vector<ObservableSpec> read_observe(Reading& reading, TableReader& output) {
    const toml::node* node = output.raw("observe");
    if (node != nullptr && !node->is_array()) {
        output.fail("observe",
                    fmt::format("is {}, must be a list; write for example [\"area_fraction\"]", kind_of(*node)));
    }
    std::vector<ObservableSpec> specs;
    const std::vector<std::string> columns = series_columns(reading.scenario.scene);
    const std::set<std::string> fixed(columns.begin(), columns.end());
    std::set<std::string> labels;
    std::string resolved;
    for (std::size_t k = 0; node != nullptr && k < node->as_array()->size(); ++k) {
        const std::string path = fmt::format("{}[{}]", output.path("observe"), k);
        ObservableSpec spec = read_observed(reading, output, *node->as_array()->get(k), path, resolved);
        if (fixed.contains(spec.label)) {
            throw InputError(output.where("observe"),
                             fmt::format("{}: series.csv has a column \"{}\" already; leave this one out, or give it a "
                                         "label of its own",
                                         path, spec.label));
        }
        if (!labels.insert(spec.label).second) {
            output.fail("observe",
                        fmt::format("there are two columns \"{}\"; give each a label of its own", spec.label));
        }
        specs.push_back(std::move(spec));
    }
    output.write("observe", "[" + resolved + "]");
    return specs;
}

void read_expectations(Reading& reading) {
    const Scene& scene = reading.scenario.scene;
    for (const TableItem& item : reading.top.array_of_tables("expect")) {
        TableReader table(reading.document, item, key_table("expect"));
        Expectation expectation;
        expectation.observable = read_spec(scene, table);
        expectation.statistic = read_statistic(table);
        read_window(table, expectation);
        read_band(table, expectation);
        expectation.unit = read_unit(table, scene, expectation.observable);
        expectation.source = table.text("source", "");
        reading.scenario.expectations.push_back(std::move(expectation));
        append_section(reading.resolved, "[[expect]]", table);
    }
}

}  // namespace polargrain
