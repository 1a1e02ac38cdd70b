#include <algorithm>

#include "scenarios/grain_groups.h"
#include "scenarios/toml_text.h"
#include "src/core/elementary.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

double read_angle(TableReader& table, double fallback) {
    return table.number("angle", k_any_number, fallback) * k_radians_per_degree;
}

/// Overrides for the first grain of a row: what is left out stays as in the row and is not written.
void read_first(Reading& reading, ShapeBook& shapes, TableReader& row, Grain& grain, GrainIndex id) {
    if (row.raw("first") == nullptr) return;
    TableReader table = row.table("first", key_table("rows.first"));
    if (table.has("shape")) {
        grain.shape = shapes.use(reading.scenario.scene, read_shape_name(shapes, table, "shape"), 1.0, id);
    }
    if (table.has("material")) grain.material = read_grain_material(reading.scenario.scene, table);
    if (table.has("position")) grain.position = table.point("position");
    if (table.has("angle")) grain.angle = read_angle(table, 0.0);
    if (table.has("velocity")) grain.velocity = table.point("velocity");
    if (table.has("spin")) grain.spin = table.number("spin", k_any_number);
    row.adopt("first", table);
}

struct Source {
    std::string section;
    TableItem item;
};

/// Tables that make grains in the order of the file; those that only the command line made come last.
std::vector<Source> sources_in_order(Reading& reading) {
    std::vector<Source> sources;
    for (const char* section : {"grains", "rows", "fill"}) {
        for (TableItem& item : reading.top.array_of_tables(section)) sources.push_back({section, std::move(item)});
    }
    std::stable_sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
        const toml::source_position p = a.item.table->source().begin;
        const toml::source_position q = b.item.table->source().begin;
        if ((p.line == 0) != (q.line == 0)) return q.line == 0;
        return p < q;
    });
    return sources;
}

GrainIndex announced(Reading& reading, const Source& source) {
    if (source.section == "grains") return 1;
    TableReader table(reading.document, source.item, key_table(source.section));
    return static_cast<GrainIndex>(table.integer("count", 1, k_most_grains));
}

}  // namespace

void require_known_shape(const ShapeBook& shapes, const TableReader& table, const std::string& key,
                         const std::string& name) {
    const std::vector<std::string>& names = shapes.names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    const std::string nearest = nearest_name(name, names);
    table.fail(key, fmt::format("there is no shape \"{}\"; {}", name,
                                nearest.empty() ? fmt::format("add [shapes.{}]", toml_key(name))
                                                : fmt::format("did you mean \"{}\"?", nearest)));
}

std::string read_shape_name(const ShapeBook& shapes, TableReader& table, const std::string& key) {
    std::string name = table.text(key);
    require_known_shape(shapes, table, key, name);
    return name;
}

MaterialIndex read_grain_material(const Scene& scene, TableReader& table) {
    const MaterialIndex material = read_material(scene, table, "material");
    if (!(scene.materials[material].density > 0.0)) {
        const std::string& name = scene.materials[material].name;
        table.fail(
            "material",
            fmt::format("grains of \"{}\" have no mass; add density = ... (kg/m^3) to [materials.{}]", name, name));
    }
    return material;
}

std::vector<Grain> read_single(Reading& reading, ShapeBook& shapes, TableReader& table, GrainIndex first) {
    Grain grain;
    grain.shape = shapes.use(reading.scenario.scene, read_shape_name(shapes, table, "shape"), 1.0, first);
    grain.material = read_grain_material(reading.scenario.scene, table);
    grain.position = table.point("position");
    grain.angle = read_angle(table, 0.0);
    grain.velocity = table.point("velocity", Vec2::Zero());
    grain.spin = table.number("spin", k_any_number, 0.0);
    return {grain};
}

std::vector<Grain> read_row(Reading& reading, ShapeBook& shapes, TableReader& table, GrainIndex first) {
    Scene& scene = reading.scenario.scene;
    const std::string shape = read_shape_name(shapes, table, "shape");
    Grain grain;
    grain.material = read_grain_material(scene, table);
    const std::int64_t count = table.integer("count", 1, k_most_grains);
    const Vec2 start = table.point("start");
    const Vec2 step = table.point("step");
    grain.angle = read_angle(table, 0.0);
    grain.velocity = table.point("velocity", Vec2::Zero());
    grain.spin = table.number("spin", k_any_number, 0.0);
    std::vector<Grain> grains;
    for (std::int64_t k = 0; k < count; ++k) {
        grain.shape = shapes.use(scene, shape, 1.0, first + static_cast<GrainIndex>(k));
        grain.position = start + static_cast<double>(k) * step;
        grains.push_back(grain);
    }
    read_first(reading, shapes, table, grains.front(), first);
    return grains;
}

std::vector<GrainGroup> read_grain_groups(Reading& reading, ShapeBook& shapes) {
    const std::vector<Source> sources = sources_in_order(reading);
    std::vector<GrainGroup> groups;
    GrainIndex next = 0;
    for (const Source& source : sources) {
        groups.push_back({source.item.path, source.item.where, next, {}});
        next += announced(reading, source);
        if (next > k_most_grains) {
            throw InputError(source.item.where, fmt::format("{}: makes more than {} grains in all; lower the count",
                                                            source.item.path, k_most_grains));
        }
    }
    FillSurroundings surroundings{{reading.scenario.scene.walls, reading.scenario.settle.has_value()}, {}, 0};
    std::vector<std::string> resolved(sources.size());
    for (const bool fills : {false, true}) {
        for (std::size_t k = 0; k < sources.size(); ++k) {
            const std::string& section = sources[k].section;
            if ((section == "fill") != fills) continue;
            GrainGroup& group = groups[k];
            TableReader table(reading.document, sources[k].item, key_table(section));
            if (section == "grains") group.grains = read_single(reading, shapes, table, group.first);
            if (section == "rows") group.grains = read_row(reading, shapes, table, group.first);
            if (fills) group.grains = read_fill(reading, shapes, table, group.first, surroundings);
            if (fills) ++surroundings.fill;
            surroundings.groups.push_back(&group);
            append_section(resolved[k], "[[" + section + "]]", table);
        }
    }
    for (const std::string& text : resolved) reading.resolved += text;
    for (const GrainGroup& group : groups) {
        for (const Grain& grain : group.grains) reading.scenario.scene.add(grain);
    }
    check_no_overlap(reading.scenario.scene, surroundings.walls, groups);
    return groups;
}

}  // namespace polargrain
