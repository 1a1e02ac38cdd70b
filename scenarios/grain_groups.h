#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/fill.h"
#include "scenarios/sections.h"

namespace polargrain {

/// In one table.
inline constexpr std::int64_t k_most_grains = 1'000'000;

/// The grains of one [[grains]], [[rows]] or [[fill]] table.
struct GrainGroup {
    std::string path;  ///< "rows[0]"
    SourceLocation where;
    GrainIndex first = 0;  ///< id of the first of them
    std::vector<Grain> grains;
};

/// Reads all tables that make grains, in the order of the file, and adds their grains to the scene in that order.
///
/// Fills come last in place, so that they keep clear of the others, wherever these stand in the file.
std::vector<GrainGroup> read_grain_groups(Reading& reading, ShapeBook& shapes);

/// One grain of a [[grains]] table, or all of a [[rows]] table. `first` is the id of the first.
std::vector<Grain> read_single(Reading& reading, ShapeBook& shapes, TableReader& table, GrainIndex first);
std::vector<Grain> read_row(Reading& reading, ShapeBook& shapes, TableReader& table, GrainIndex first);

/// What the fills need to know beside their table.
struct FillSurroundings {
    StartWalls walls;
    std::vector<const GrainGroup*> groups;  ///< whose grains are in place
    std::uint64_t fill = 0;                 ///< running number of the fill
};

/// Reads a [[fill]] table and finds places for its grains; InputError where there is no room.
std::vector<Grain> read_fill(Reading& reading, ShapeBook& shapes, TableReader& table, GrainIndex first,
                             const FillSurroundings& surroundings);

/// The shape that the key names, for grain number `grain`; InputError with the nearest one otherwise.
std::string read_shape_name(const ShapeBook& shapes, TableReader& table, const std::string& key);
void require_known_shape(const ShapeBook& shapes, const TableReader& table, const std::string& key,
                         const std::string& name);
/// A material for grains: it must have a density.
MaterialIndex read_grain_material(const Scene& scene, TableReader& table);

/// Refuses grains that overlap one another or a wall before the first step; names both by id and by where they come
/// from. Cost: linear in the number of grains.
void check_no_overlap(const Scene& scene, const StartWalls& walls, const std::vector<GrainGroup>& groups);

}  // namespace polargrain
