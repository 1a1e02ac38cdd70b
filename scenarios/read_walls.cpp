#include <set>

#include "scenarios/sections.h"

namespace polargrain {

namespace {

SineMotion read_sine(TableReader& table) {
    SineMotion motion;
    const Vec2 direction = table.point("direction");
    if (!(direction.squaredNorm() > 0.0)) table.fail("direction", "has no length; give for example [0, 1]");
    motion.direction = unit(direction);
    motion.amplitude = table.number("amplitude", k_not_negative);
    motion.frequency = table.number("frequency", k_positive);
    motion.start = table.number("start", k_not_negative, 0.0);
    return motion;
}

RotationMotion read_rotation(TableReader& table) {
    RotationMotion motion;
    motion.centre = table.point("centre");
    motion.rate = table.number("rate", k_any_number);
    motion.start = table.number("start", k_not_negative, 0.0);
    return motion;
}

LinearMotion read_linear(TableReader& table) {
    LinearMotion motion;
    motion.velocity = table.point("velocity");
    if (!(motion.velocity.squaredNorm() > 0.0)) {
        table.fail("velocity", "is zero; give for example [0.1, 0], or leave `motion` out");
    }
    motion.start = table.number("start", k_not_negative, 0.0);
    motion.end = table.optional_number("end", k_not_negative);
    if (motion.end && *motion.end <= motion.start) {
        table.fail("end", fmt::format("{} s is not after the start at {} s; give a later time, or leave it out for a "
                                      "wall that never stops",
                                      *motion.end, motion.start));
    }
    return motion;
}

WallMotion motion_of_type(const std::string& type, TableReader& table) {
    if (type == "sine") return read_sine(table);
    if (type == "rotate") return read_rotation(table);
    return read_linear(table);
}

WallMotion read_motion(TableReader& wall) {
    if (wall.raw("motion") == nullptr) return {};
    const std::vector<std::string> types = key_variants("walls.motion");
    const std::string type = wall.untyped_table("motion").variant("type", types);
    TableReader table = wall.table("motion", key_table("walls.motion", type));
    table.choice("type", types);
    WallMotion motion = motion_of_type(type, table);
    wall.adopt("motion", table);
    return motion;
}

std::vector<Vec2> read_points(TableReader& table) {
    std::vector<Vec2> points = table.points("points", 2);
    for (std::size_t k = 1; k < points.size(); ++k) {
        if ((points[k] - points[k - 1]).squaredNorm() < 1e-24) {
            table.fail("points", fmt::format("points {} and {} (counted from 0) coincide; leave one out", k - 1, k));
        }
    }
    return points;
}

}  // namespace

void read_walls(Reading& reading) {
    Scene& scene = reading.scenario.scene;
    std::set<std::string> names;
    for (const TableItem& item : reading.top.array_of_tables("walls")) {
        TableReader table(reading.document, item, key_table("walls"));
        Wall wall;
        wall.name = table.text("name");
        if (!is_plain_name(wall.name)) {
            table.fail("name", fmt::format("\"{}\": a name is made of letters, digits, _ and -; rename it", wall.name));
        }
        if (!names.insert(wall.name).second) {
            table.fail("name", fmt::format("there is a wall \"{}\" already; give each its own name", wall.name));
        }
        wall.material = read_material(scene, table, "material");
        wall.points = read_points(table);
        wall.motion = read_motion(table);
        wall.remove_at = table.optional_number("remove_at", k_not_negative);
        scene.walls.push_back(std::move(wall));
        append_section(reading.resolved, "[[walls]]", table);
    }
}

}  // namespace polargrain
