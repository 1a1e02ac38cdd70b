#include "scenarios/sections.h"
#include "scenarios/toml_text.h"
#include "shapes/library.h"
#include "src/core/elementary.h"

namespace polargrain {

namespace {

constexpr std::int64_t k_most_vertices = 10'000;

int read_count(TableReader& table, std::string_view key, std::int64_t low, std::optional<std::int64_t> fallback = {}) {
    return static_cast<int>(table.integer(key, low, k_most_vertices, fallback));
}

RectangleSpec read_rectangle(TableReader& table) {
    RectangleSpec spec;
    spec.width = table.number("width", k_positive);
    spec.height = table.number("height", k_positive);
    spec.vertices = read_count(table, "vertices", 4, spec.vertices);
    return spec;
}

RegularSpec read_regular(TableReader& table) {
    RegularSpec spec;
    spec.radius = table.number("radius", k_positive);
    spec.sides = read_count(table, "sides", 3);
    return spec;
}

EllipseSpec read_ellipse(TableReader& table) {
    EllipseSpec spec;
    spec.width = table.number("width", k_positive);
    spec.height = table.number("height", k_positive);
    spec.vertices = read_count(table, "vertices", 3, spec.vertices);
    return spec;
}

SuperellipseSpec read_superellipse(TableReader& table) {
    SuperellipseSpec spec;
    spec.width = table.number("width", k_positive);
    spec.height = table.number("height", k_positive);
    spec.exponent = table.number("exponent", k_positive, spec.exponent);
    spec.vertices = read_count(table, "vertices", 3, spec.vertices);
    return spec;
}

StickSpec read_stick(TableReader& table) {
    StickSpec spec;
    spec.length = table.number("length", k_positive);
    spec.width = table.number("width", k_positive);
    spec.vertices = read_count(table, "vertices", 4, spec.vertices);
    return spec;
}

StarSpec read_star(TableReader& table) {
    StarSpec spec;
    spec.radius = table.number("radius", k_positive);
    spec.inner_radius = table.number("inner_radius", k_positive);
    spec.points = read_count(table, "points", 2, spec.points);
    return spec;
}

RoughSpec read_rough(TableReader& table) {
    RoughSpec spec;
    spec.radius = table.number("radius", k_positive);
    spec.roughness = table.number("roughness", k_fraction);
    spec.vertices = read_count(table, "vertices", 3, spec.vertices);
    const std::vector<std::int64_t> modes =
        table.integers("modes", 1, 1000, std::vector<std::int64_t>{spec.first_mode, spec.last_mode});
    if (modes.size() != 2 || modes[0] > modes[1]) {
        table.fail("modes", "must be the first and the last mode, two rising whole numbers such as [2, 6]");
    }
    spec.first_mode = static_cast<int>(modes[0]);
    spec.last_mode = static_cast<int>(modes[1]);
    spec.same = table.flag("same", spec.same);
    return spec;
}

PolarSpec read_polar(TableReader& table) {
    PolarSpec spec;
    if (table.has("radii") == table.has("vertices")) {
        throw InputError(table.where(), table.path() +
                                            ": give either radii = [...] (at equal angles) or vertices = "
                                            "[[radius, degrees], ...]");
    }
    if (table.has("radii")) {
        const std::vector<double> radii = table.numbers("radii", k_positive, 3);
        const auto count = static_cast<double>(radii.size());
        for (std::size_t k = 0; k < radii.size(); ++k) {
            spec.vertices.emplace_back(radii[k], 2.0 * k_pi * static_cast<double>(k) / count);
        }
    } else {
        for (const Vec2& vertex : table.points("vertices", 3)) {
            spec.vertices.emplace_back(vertex.x(), vertex.y() * k_radians_per_degree);
        }
    }
    return spec;
}

/// The resolved scenario holds the scaled points themselves, so that it needs no other file.
OutlineSpec read_outline_of_file(TableReader& table, const std::filesystem::path& folder) {
    OutlineSpec spec;
    const std::string path = table.text("path");
    const double scale = table.number("scale", k_positive, 1.0);
    try {
        spec.points = find_outline(path, folder).points;
    } catch (const InputError& error) {
        table.fail("path", error.what());
    }
    for (Vec2& point : spec.points) point *= scale;
    table.discard_resolved();
    table.write("type", toml_text(std::string_view{"outline"}));
    table.write("points", toml_text(spec.points));
    return spec;
}

ShapeSpec read_spec(TableReader& table, const std::string& type, const std::filesystem::path& folder) {
    if (type == "file") return read_outline_of_file(table, folder);
    table.write("type", toml_text(std::string_view{type}));
    if (type == "rectangle") return read_rectangle(table);
    if (type == "disk") return DiskSpec{table.number("radius", k_positive)};
    if (type == "regular") return read_regular(table);
    if (type == "ellipse") return read_ellipse(table);
    if (type == "superellipse") return read_superellipse(table);
    if (type == "stick") return read_stick(table);
    if (type == "star") return read_star(table);
    if (type == "rough") return read_rough(table);
    if (type == "polar") return read_polar(table);
    return OutlineSpec{table.points("points", 3)};
}

}  // namespace

ShapeBook read_shapes(Reading& reading) {
    ShapeBook book(reading.scenario.scene.seed);
    for (const TableItem& item : reading.top.named_tables("shapes")) {
        const std::vector<std::string> types = key_variants("shapes");
        const std::string type = TableReader(reading.document, item).variant("type", types);
        TableReader table(reading.document, item, key_table("shapes", type));
        table.raw("type");
        book.declare(item.name, read_spec(table, type, reading.document.folder()), item.where);
        append_section(reading.resolved, "[" + item.path + "]", table);
    }
    return book;
}

}  // namespace polargrain
