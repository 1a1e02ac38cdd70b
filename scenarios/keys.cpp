#include "scenarios/keys.h"

#include "src/core/error.h"

namespace polargrain {

namespace {

const std::vector<KeyTable>& all_tables() {
    static const std::vector<KeyTable> tables = {
        {"",
         "",
         {"title", "source", "run", "materials", "pairs", "shapes", "walls", "grains", "rows", "fill", "settle", "dem",
          "box2d", "output", "expect"}},
        {"run", "", {"engine", "duration", "time_step", "time_step_factor", "gravity", "incline", "seed", "threads"}},
        {"materials", "", {"density", "restitution", "friction"}},
        {"materials.restitution", "", {"mean", "stddev"}},
        {"pairs", "", {"between", "friction", "restitution"}},
        {"pairs.restitution", "", {"mean", "stddev"}},
        {"shapes", "rectangle", {"type", "width", "height", "vertices"}},
        {"shapes", "disk", {"type", "radius"}},
        {"shapes", "regular", {"type", "radius", "sides"}},
        {"shapes", "ellipse", {"type", "width", "height", "vertices"}},
        {"shapes", "superellipse", {"type", "width", "height", "exponent", "vertices"}},
        {"shapes", "stick", {"type", "length", "width", "vertices"}},
        {"shapes", "star", {"type", "radius", "inner_radius", "points"}},
        {"shapes", "rough", {"type", "radius", "roughness", "vertices", "modes", "same"}},
        {"shapes", "polar", {"type", "radii", "vertices"}},
        {"shapes", "outline", {"type", "points"}},
        {"shapes", "file", {"type", "path", "scale"}},
        {"walls", "", {"name", "material", "points", "motion", "remove_at"}},
        {"walls.motion", "sine", {"type", "direction", "amplitude", "frequency", "start"}},
        {"walls.motion", "rotate", {"type", "centre", "rate", "start"}},
        {"walls.motion", "linear", {"type", "velocity", "start", "end"}},
        {"grains", "", {"shape", "material", "position", "angle", "velocity", "spin"}},
        {"rows", "", {"shape", "material", "count", "start", "step", "angle", "velocity", "spin", "first"}},
        {"rows.first", "", {"shape", "material", "position", "angle", "velocity", "spin"}},
        {"fill", "", {"count", "shapes", "material", "region", "size", "velocity", "velocity_spread", "spin_spread"}},
        {"fill.size", "uniform", {"distribution", "min", "max"}},
        {"fill.size", "normal", {"distribution", "mean", "stddev", "min", "max"}},
        {"fill.size", "lognormal", {"distribution", "mean", "stddev", "min", "max"}},
        {"settle", "", {"until_energy", "at_most"}},
        {"dem",
         "",
         {"law", "tangential", "tension", "stiffness", "exponent", "damping_exponent", "tangential_stiffness",
          "tangential_damping", "target_overlap", "polygons", "area_exponent", "search", "skin", "integrator",
          "resolution", "pairs"}},
        {"dem.pairs",
         "",
         {"between", "law", "tangential", "tension", "stiffness", "exponent", "damping_exponent",
          "tangential_stiffness", "tangential_damping"}},
        {"box2d",
         "",
         {"velocity_iterations", "position_iterations", "unit", "skin", "restitution_threshold", "continuous"}},
        {"output", "", {"frames", "trajectory", "series", "impacts", "checkpoint", "observe"}},
        {"output.frames",
         "",
         {"every", "format", "width", "height", "colour", "contacts", "view", "colour_max", "follow"}},
        {"output.trajectory", "", {"every"}},
        {"output.series", "", {"every"}},
        {"output.checkpoint", "", {"every_wall"}},
        {"output.observe",
         "",
         {"quantity", "label", "region", "opening", "wall", "shape", "material", "started_in", "cell"}},
        {"expect",
         "",
         {"quantity", "label", "region", "opening", "wall", "shape", "material", "started_in", "cell", "statistic",
          "from", "to", "min", "max", "unit", "source"}},
    };
    return tables;
}

}  // namespace

std::span<const KeyTable> key_tables() { return all_tables(); }

const KeyTable& key_table(std::string_view path, std::string_view variant) {
    for (const KeyTable& table : all_tables()) {
        if (table.path == path && table.variant == variant) return table;
    }
    broken_invariant("key table exists", __FILE__, __LINE__, fmt::format("path {}, variant {}", path, variant));
}

std::vector<std::string> key_variants(std::string_view path) {
    std::vector<std::string> variants;
    for (const KeyTable& table : all_tables()) {
        if (table.path == path) variants.push_back(table.variant);
    }
    return variants;
}

}  // namespace polargrain
