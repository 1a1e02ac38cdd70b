#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/shape_book.h"
#include "scenarios/table_reader.h"
#include "src/model/settings.h"

namespace polargrain {

// One function for each table of a scenario file: reads and checks it, and appends it to the resolved text.

/// What the readers of the tables share.
struct Reading {
    const Document& document;
    TableReader& top;
    Scenario& scenario;
    std::string& resolved;
};

/// Finishes a table and appends it under a header such as "[run]" or "[[walls]]".
void append_section(std::string& resolved, const std::string& header, const TableReader& table);

void read_run(Reading& reading);
void read_settle(Reading& reading);
void read_output(Reading& reading);
void read_expectations(Reading& reading);
/// The observables of output.observe, checked against the scene, which must be complete.
std::vector<ObservableSpec> read_observe(Reading& reading, TableReader& output);
/// [box2d] is in the resolved scenario where the file has it or the engine is box2d.
void read_box2d(Reading& reading);
/// The same for [dem] and [[dem.pairs]].
void read_dem(Reading& reading);

void read_materials(Reading& reading);
void read_pairs(Reading& reading);
void read_walls(Reading& reading);
ShapeBook read_shapes(Reading& reading);

/// The two materials that `between` names; each pair once, as `seen` keeps count.
std::pair<MaterialIndex, MaterialIndex> read_material_pair(const Scene& scene, TableReader& table,
                                                           std::set<std::pair<MaterialIndex, MaterialIndex>>& seen);

/// Index of the material that the key names; InputError with the nearest one otherwise.
MaterialIndex read_material(const Scene& scene, TableReader& table, const std::string& key);

}  // namespace polargrain
