#include "scenarios/sections.h"

namespace polargrain {

namespace {

constexpr NumberRange k_skin{0.0, 0.1, "between 0 and 0.1 (of Box2D's units)"};
constexpr int k_most_iterations = 10'000;

}  // namespace

void read_box2d(Reading& reading) {
    TableReader table = reading.top.table("box2d", key_table("box2d"));
    Box2dSettings& settings = reading.scenario.engines.box2d;
    settings.velocity_iterations =
        static_cast<int>(table.integer("velocity_iterations", 1, k_most_iterations, settings.velocity_iterations));
    settings.position_iterations =
        static_cast<int>(table.integer("position_iterations", 1, k_most_iterations, settings.position_iterations));
    settings.unit = table.optional_number("unit", k_positive);
    settings.skin = table.number("skin", k_skin, settings.skin);
    settings.restitution_threshold = table.optional_number("restitution_threshold", k_not_negative);
    settings.continuous = table.flag("continuous", settings.continuous);
    // In the way of no scenario that is run by another engine.
    if (!reading.top.has("box2d") && reading.scenario.run.engine != "box2d") return;
    append_section(reading.resolved, "[box2d]", table);
}

}  // namespace polargrain
