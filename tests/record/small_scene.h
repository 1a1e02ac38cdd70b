#pragma once

#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "src/geometry/shape.h"
#include "src/run/sink.h"

namespace polargrain::testing {

/// A folder of its own for one test, gone afterwards.
class TemporaryFolder {
public:
    explicit TemporaryFolder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() / ("polargrain-" + name + "-" + std::to_string(getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

inline std::string content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Rows of a CSV file without quoted fields, header first.
inline std::vector<std::vector<std::string>> csv_rows(const std::filesystem::path& path) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(content(path));
    for (std::string line; std::getline(text, line);) {
        rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

/// An L-shaped outline about its centre of mass; re-entrant at one vertex. Area 3 d^2 for the side 2 d.
inline PolarPolygon bracket(double d) {
    // Three unit squares at (.5,.5), (1.5,.5), (.5,1.5): centroid (5/6, 5/6); the inner corner (1,1) sees it.
    const std::array<Vec2, 6> corners = {Vec2(0, 0), Vec2(2, 0), Vec2(2, 1), Vec2(1, 1), Vec2(1, 2), Vec2(0, 2)};
    std::vector<Vec2> vertices;
    for (const Vec2& corner : corners) vertices.emplace_back(d * (corner - Vec2(5.0 / 6.0, 5.0 / 6.0)));
    MassProperties mass;
    mass.area = 3.0 * d * d;
    // Each square: d^4 / 6 about its own centre, and the squared distances of the centres, 1/9 + 1/9 and twice
    // 4/9 + 1/9, by Steiner.
    mass.polar_moment = d * d * d * d * (3.0 / 6.0 + 12.0 / 9.0);
    return {"bracket", vertices, mass};
}

/// Two disks and two brackets over a floor, beside a shaken and a turning wall and one that is removed.
inline Scene small_scene() {
    Scene scene;
    scene.gravity = {0.5, -9.81};
    scene.seed = 7;
    scene.materials.add({"stone", 2500.0, {0.4, 0.1}, 0.6});
    scene.materials.add({"steel", 7800.0, {0.8, 0.0}, 0.2});
    scene.add(std::make_shared<const Shape>(Disk("ball", 0.01)));
    scene.add(std::make_shared<const Shape>(bracket(0.008)));
    scene.add(std::make_shared<const Shape>(bracket(0.009)));  // the same name twice: each grain its own draw
    scene.add(Grain{0, 0, {0.02, 0.011}, 0.3, {0.1, -0.2}, 1.5});
    scene.add(Grain{0, 1, {0.05, 0.011}, -0.3, {0.0, 1.0 / 3.0}, 0.0});
    scene.add(Grain{1, 0, {0.08, 0.02}, 1.0, {-0.1, 0.0}, -2.0});
    scene.add(Grain{2, 1, {0.12, 0.03}, 2.0, {0.0, 0.0}, 0.1});
    scene.walls.push_back({"floor", 1, {{0.0, 0.0}, {0.2, 0.0}}, {}, {}});
    scene.walls.push_back({"shaker", 1, {{-0.01, 0.1}, {-0.01, 0.0}}, SineMotion{Vec2::UnitX(), 0.002, 20.0, 0.0}, {}});
    scene.walls.push_back({"paddle", 1, {{0.2, 0.05}, {0.25, 0.05}}, RotationMotion{{0.2, 0.05}, 3.0, 0.0}, {}});
    scene.walls.push_back({"gate", 0, {{0.2, 0.0}, {0.22, 0.0}}, {}, 0.01});
    return scene;
}

inline RunInfo run_info() {
    RunInfo info;
    info.title = "Small scene";
    info.source = "made up for this test";
    info.engine = "none";
    info.dt = 0.001;
    info.duration = 0.02;
    return info;
}

/// What a step of an engine might tell: two contacts, forces on the walls that grow with the step.
inline StepReport report_at(const Scene& scene, std::int64_t step) {
    StepReport report;
    report.clear(scene.walls.size());
    const double s = static_cast<double>(step);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        report.walls[w].linear = Vec2(0.001, -0.002) * s * static_cast<double>(w + 1);
        report.walls[w].angular = 1e-5 * s;
    }
    for (std::int64_t c = 0; c < step % 3; ++c) {
        report.contacts.push_back({wall_body(0), static_cast<BodyIndex>(c),
                                   Vec2(0.02 + 0.03 * static_cast<double>(c), 0.0), Vec2::UnitY(), -1e-6 * s,
                                   Vec2(0.01, 0.3) / (s + 1.0)});
    }
    return report;
}

/// The scene's grains, each carried on at its own velocity: numbers with all their digits used.
inline World world_at(const Scene& scene, std::int64_t step, double dt) {
    World world = initial_world(scene);
    world.step = step;
    world.time = static_cast<double>(step) * dt;
    for (std::size_t k = 0; k < world.grains.x.size(); ++k) {
        world.grains.x[k] += world.time * world.grains.vx[k];
        world.grains.y[k] += world.time * world.grains.vy[k];
        world.grains.angle[k] += world.time * world.grains.spin[k];
    }
    return world;
}

}  // namespace polargrain::testing
