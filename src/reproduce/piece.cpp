#include "src/reproduce/piece.h"

#include <cstring>

#include "shapes/shape_spec.h"
#include "src/core/hash.h"
#include "src/model/step_report.h"

namespace polargrain {

namespace {

void add_text(StateHash& hash, const std::string& text) {
    hash.add(static_cast<std::int64_t>(text.size()));
    for (std::size_t at = 0; at < text.size(); at += sizeof(std::int64_t)) {
        std::int64_t word = 0;
        std::memcpy(&word, text.data() + at, std::min(sizeof word, text.size() - at));
        hash.add(word);
    }
}

/// Polygons and disks that fall upon one another in a box: every part of an engine has something to do.
Scene crowded_scene() {
    Scene scene;
    scene.gravity = {0.0, -9.81};
    scene.materials.add({"stone", 2500.0, {0.6, 0.05}, 0.3});
    const std::vector<ShapeSpec> specs{RoughSpec{.radius = 0.01, .roughness = 0.15}, DiskSpec{0.01},
                                       StarSpec{0.012, 0.006, 5}, RectangleSpec{0.025, 0.006, 12}};
    for (std::size_t s = 0; s < specs.size(); ++s) {
        scene.add(std::make_shared<const Shape>(make_shape("probe", specs[s], 7, s)));
    }
    scene.walls.push_back({"box", 0, {{0.0, 0.4}, {0.0, 0.0}, {0.1, 0.0}, {0.1, 0.4}}, {}, std::nullopt});
    for (int k = 0; k < 24; ++k) {
        const int row = k / 3;
        scene.add(Grain{.shape = k % 4,
                        .position = {0.02 + 0.03 * (k % 3), 0.02 + 0.03 * row},
                        .angle = 0.3 * k,
                        .velocity = {0.2 * ((k % 5) - 2), 0.0},
                        .spin = 3.0 * ((k % 3) - 1)});
    }
    return scene;
}

}  // namespace

std::string engine_fingerprint(const EngineAtHand& engine) {
    const Scene scene = crowded_scene();
    const std::unique_ptr<Engine> probe = engine.make(scene);
    World world = initial_world(scene);
    StepReport report;
    for (int k = 0; k < 300; ++k) probe->step(world, 5e-4, report);
    return state_hash(world);
}

std::string piece_key(const Piece& piece, const std::string& fingerprint) {
    StateHash hash;
    add_text(hash, piece.scenario);
    add_text(hash, fingerprint);
    return hash.hex();
}

}  // namespace polargrain
