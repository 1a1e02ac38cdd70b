#include <set>

#include "scenarios/sections.h"
#include "scenarios/toml_text.h"
#include "src/core/nearest_name.h"

namespace polargrain {

namespace {

/// A plain number, or { mean, stddev }.
Restitution read_restitution(TableReader& table, const std::string& table_path) {
    const toml::node* node = table.raw("restitution");
    if (node == nullptr || !node->is_table()) return {table.number("restitution", k_fraction), 0.0};
    TableReader spread = table.table("restitution", key_table(table_path + ".restitution"));
    Restitution restitution;
    restitution.mean = spread.number("mean", k_fraction);
    restitution.stddev = spread.number("stddev", {0.0, 10.0, "between 0 and 10"}, 0.0);
    table.adopt("restitution", spread);
    return restitution;
}

std::vector<std::string> material_names(const Materials& materials) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(materials.size()));
    for (MaterialIndex m = 0; m < materials.size(); ++m) names.push_back(materials[m].name);
    return names;
}

MaterialIndex find_material(const Scene& scene, const TableReader& table, const std::string& key,
                            const std::string& name) {
    const std::optional<MaterialIndex> found = scene.materials.find(name);
    if (!found) {
        const std::vector<std::string> names = material_names(scene.materials);
        const std::string nearest = nearest_name(name, names);
        table.fail(key, fmt::format("there is no material \"{}\"; {}", name,
                                    nearest.empty() ? fmt::format("add [materials.{}]", toml_key(name))
                                                    : fmt::format("did you mean \"{}\"?", nearest)));
    }
    return *found;
}

}  // namespace

MaterialIndex read_material(const Scene& scene, TableReader& table, const std::string& key) {
    return find_material(scene, table, key, table.text(key));
}

std::pair<MaterialIndex, MaterialIndex> read_material_pair(const Scene& scene, TableReader& table,
                                                           std::set<std::pair<MaterialIndex, MaterialIndex>>& seen) {
    const std::vector<std::string> names = table.words("between");
    if (names.size() != 2) table.fail("between", fmt::format("names {} materials, must name two", names.size()));
    const MaterialIndex a = find_material(scene, table, "between", names[0]);
    const MaterialIndex b = find_material(scene, table, "between", names[1]);
    if (!seen.insert(std::minmax(a, b)).second) {
        table.fail("between",
                   fmt::format("the pair {} and {} has an entry already; merge the two", names[0], names[1]));
    }
    return {a, b};
}

void read_materials(Reading& reading) {
    for (const TableItem& item : reading.top.named_tables("materials")) {
        TableReader table(reading.document, item, key_table("materials"));
        Material material;
        material.name = item.name;
        material.density = table.optional_number("density", k_positive).value_or(0.0);
        material.restitution = read_restitution(table, "materials");
        material.friction = table.number("friction", k_not_negative);
        reading.scenario.scene.materials.add(std::move(material));
        append_section(reading.resolved, "[" + item.path + "]", table);
    }
}

void read_pairs(Reading& reading) {
    Scene& scene = reading.scenario.scene;
    std::set<std::pair<MaterialIndex, MaterialIndex>> seen;
    for (const TableItem& item : reading.top.array_of_tables("pairs")) {
        TableReader table(reading.document, item, key_table("pairs"));
        const auto [a, b] = read_material_pair(scene, table, seen);
        const std::optional<double> friction = table.optional_number("friction", k_not_negative);
        std::optional<Restitution> restitution;
        if (table.has("restitution")) restitution = read_restitution(table, "pairs");
        if (!friction && !restitution) {
            throw InputError(item.where, item.path + ": says nothing; give friction, restitution or both");
        }
        scene.materials.set_pair(a, b, friction, restitution);
        append_section(reading.resolved, "[[pairs]]", table);
    }
}

}  // namespace polargrain
