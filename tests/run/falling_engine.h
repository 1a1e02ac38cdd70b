#pragma once

#include "src/model/engine.h"

namespace polargrain {

/// Free fall without contacts, in closed form per step; enough to test everything around an engine.
///
/// With a floor height it stops grains dead there, so that a scene can come to rest.
class FallingEngine : public Engine {
public:
    explicit FallingEngine(const Scene& scene, double suggested = 1e-3) : scene_(scene), suggested_(suggested) {}

    std::string_view name() const override { return "falling"; }
    double suggested_dt() const override { return suggested_; }

    void step(World& world, double dt, StepReport& report) override {
        report.clear(scene_.walls.size());
        Grains& g = world.grains;
        for (GrainIndex k = 0; k < g.size(); ++k) {
            g.set_position(k, g.position(k) + dt * g.velocity(k) + 0.5 * dt * dt * scene_.gravity);
            g.set_velocity(k, g.velocity(k) + dt * scene_.gravity);
            if (!scene_.walls.empty() && g.y[Grains::at(k)] <= 0.0) land(g, k, report);
        }
        world.step += 1;
        world.time = static_cast<double>(world.step) * dt;
        ++steps_taken_;
        report.moves.tried = g.size();
        report.impacts = 2;
        report.deepest = 1.0 / static_cast<double>(world.step);
        report.ledger.friction_loss = 0.5;
    }

    void save(Checkpoint& checkpoint) const override { checkpoint.put("steps_taken", std::vector{steps_taken_}); }
    void load(const Checkpoint& checkpoint) override { steps_taken_ = checkpoint.integers("steps_taken").at(0); }

    std::int64_t steps_taken() const { return steps_taken_; }
    const Scene& scene() const { return scene_; }

private:
    static void land(Grains& g, GrainIndex k, StepReport& report) {
        g.set_position(k, {g.x[Grains::at(k)], 0.0});
        g.set_velocity(k, Vec2::Zero());
        report.contacts.push_back({.a = wall_body(0), .b = k});
    }

    const Scene& scene_;
    double suggested_;
    std::int64_t steps_taken_ = 0;
};

/// One disk of radius 1 cm at the height [m]; with a floor under it on request.
inline Scene one_disk(double height, bool floor) {
    Scene scene;
    scene.gravity = {0.0, -9.81};
    scene.materials.add({.name = "stone", .density = 2000.0, .restitution = {}});
    scene.add(std::make_shared<const Shape>(Disk("disk", 0.01)));
    scene.add(Grain{.position = {0.0, height}});
    if (floor)
        scene.walls.push_back(
            {.name = "floor", .points = {{-1.0, -0.01}, {1.0, -0.01}}, .motion = {}, .remove_at = {}});
    return scene;
}

}  // namespace polargrain
