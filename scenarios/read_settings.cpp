#include <cmath>

#include "scenarios/sections.h"
#include "scenarios/toml_text.h"
#include "src/core/elementary.h"

namespace polargrain {

namespace {

constexpr NumberRange k_seconds{1e-9, 1e6, "a positive number of seconds (1e-9 to 1e6)"};
constexpr NumberRange k_interval{0.0, 1e6, "zero (off) or a number of seconds (1e-9 to 1e6)"};

const std::vector<std::string>& engine_names() {
    static const std::vector<std::string> names = {"contact", "contact-1994", "box2d", "dem"};
    return names;
}

std::optional<double> read_time_step(TableReader& run) {
    const toml::node* node = run.raw("time_step");
    if (node == nullptr || node->value<std::string>() == "critical") {
        run.write("time_step", toml_text(std::string_view{"critical"}));
        return {};
    }
    if (!node->is_number()) run.fail("time_step", "must be \"critical\" or a number of seconds; write one of these");
    return run.number("time_step", k_seconds);
}

double read_interval(TableReader& table, const std::string& key, double fallback) {
    const double interval = table.number(key, k_interval, fallback);
    if (interval > 0.0 && interval < k_seconds.low) {
        table.fail(key, fmt::format("is {}, must be {}", interval, k_interval.words));
    }
    return interval;
}

double read_every(TableReader& output, const std::string& key, double fallback) {
    TableReader table = output.table(key, key_table("output." + key));
    const double every = read_interval(table, "every", fallback);
    output.adopt(key, table);
    return every;
}

std::optional<std::pair<Vec2, Vec2>> read_view(TableReader& frames) {
    if (!frames.has("view")) {
        frames.raw("view");
        return {};
    }
    const std::vector<Vec2> corners = frames.points("view", 2);
    if (corners.size() != 2 || !((corners[1] - corners[0]).minCoeff() > 0.0)) {
        frames.fail("view",
                    "must be the lower left and the upper right corner, [[x0, y0], [x1, y1]] with x1 > x0, y1 > y0");
    }
    return std::pair{corners[0], corners[1]};
}

std::optional<std::string> read_followed_wall(TableReader& frames, const Scene& scene) {
    if (!frames.has("follow")) {
        frames.raw("follow");
        return {};
    }
    std::vector<std::string> names;
    for (const Wall& wall : scene.walls) names.push_back(wall.name);
    if (names.empty()) frames.fail("follow", "there are no walls to follow; leave it out");
    return frames.choice("follow", names, {});
}

FrameSettings read_frames(TableReader& output, const Scene& scene, const FrameSettings& defaults) {
    static const std::vector<std::string> formats = {"png", "svg", "pdf"};
    static const std::vector<std::string> colours = {"speed", "spin",     "angle",    "kinetic_energy", "size", "id",
                                                     "shape", "material", "contacts", "force",          "none"};
    TableReader table = output.table("frames", key_table("output.frames"));
    FrameSettings frames;
    frames.every = read_interval(table, "every", defaults.every);
    frames.format = table.choice("format", formats, defaults.format);
    frames.width = static_cast<int>(table.integer("width", 16, 16384, defaults.width));
    frames.height = static_cast<int>(table.integer("height", 0, 16384, defaults.height));
    frames.colour = table.choice("colour", colours, defaults.colour);
    frames.contacts = table.flag("contacts", defaults.contacts);
    frames.view = read_view(table);
    frames.colour_max = table.optional_number("colour_max", k_positive);
    frames.follow = read_followed_wall(table, scene);
    output.adopt("frames", table);
    return frames;
}

}  // namespace

void append_section(std::string& resolved, const std::string& header, const TableReader& table) {
    table.finish();
    resolved += "\n" + header + "\n" + table.resolved_lines();
}

void read_run(Reading& reading) {
    TableReader table = reading.top.table("run", key_table("run"));
    RunSettings& run = reading.scenario.run;
    Scene& scene = reading.scenario.scene;
    run.engine = table.choice("engine", engine_names(), std::string{k_default_engine});
    run.duration = table.number("duration", k_seconds, run.duration);
    run.time_step = read_time_step(table);
    run.time_step_factor = table.number("time_step_factor", k_positive, run.time_step_factor);
    const double gravity = table.number("gravity", k_not_negative, 9.81);
    const double incline = table.number("incline", {-180.0, 180.0, "between -180 and 180 degrees"}, 0.0);
    const auto [sine, cosine] = sine_cosine(incline * k_radians_per_degree);
    scene.gravity = {gravity * sine, -gravity * cosine};
    scene.seed = static_cast<std::uint64_t>(table.integer("seed", 0, k_largest_seed, 1));
    scene.threads = static_cast<int>(table.integer("threads", 1, k_most_threads, 1));
    append_section(reading.resolved, "[run]", table);
}

void read_settle(Reading& reading) {
    if (!reading.top.has("settle")) return;
    TableReader table = reading.top.table("settle", key_table("settle"));
    SettleSettings settle;
    settle.until_energy = table.number("until_energy", k_positive, settle.until_energy);
    settle.at_most = table.number("at_most", k_seconds, settle.at_most);
    if (!(reading.scenario.scene.gravity.squaredNorm() > 0.0)) {
        throw InputError(table.where(), "settle: nothing comes to rest where run.gravity is 0; leave [settle] out");
    }
    reading.scenario.settle = settle;
    append_section(reading.resolved, "[settle]", table);
}

void read_output(Reading& reading) {
    TableReader table = reading.top.table("output", key_table("output"));
    OutputSettings& output = reading.scenario.output;
    output.frames = read_frames(table, reading.scenario.scene, output.frames);
    output.trajectory_every = read_every(table, "trajectory", output.trajectory_every);
    output.series_every = read_every(table, "series", output.series_every);
    output.impacts = table.flag("impacts", output.impacts);
    TableReader checkpoint = table.table("checkpoint", key_table("output.checkpoint"));
    output.checkpoint_every_wall = read_interval(checkpoint, "every_wall", output.checkpoint_every_wall);
    table.adopt("checkpoint", checkpoint);
    output.observe = read_observe(reading, table);
    append_section(reading.resolved, "[output]", table);
}

}  // namespace polargrain
