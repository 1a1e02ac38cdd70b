#pragma once

#include <cstdint>
#include <memory>

#include "src/model/engine.h"

namespace polargrain::testing {

/// A scene, the engine under test, the state it has brought the scene to, and the account of the steps so far.
struct Running {
    using MakeEngine = std::unique_ptr<Engine> (*)(const Scene&);

    Running(MakeEngine make, Scene the_scene);

    const Scene scene;
    std::unique_ptr<Engine> engine;
    World world;
    StepReport report;  ///< of the last step

    double start_energy = 0.0;  ///< [J/m]
    MoveCount moves;
    EnergyLedger ledger;        ///< summed over the steps
    double ledger_error = 0.0;  ///< largest failure of the ledger of a step to explain the change of energy [J/m]
    std::int64_t impacts = 0;

    void step(double dt);

    /// Steps until `until` [s], calling `each` after every step. dt must stay the same for the life of the run.
    template <typename EachStep>
    void run(double until, double dt, EachStep each) {
        while (world.time < until - 0.5 * dt) {
            step(dt);
            each();
        }
    }
    void run(double until, double dt) {
        run(until, dt, [] {});
    }

    double total_energy() const { return energy(world.grains, scene.gravity).total(); }
    double weight() const;  ///< of all grains [N/m]
    /// Kinetic energy over (weight x length): per grain in units of m g d where all grains are alike.
    double restlessness(double length) const;
    double rejected_share() const;
    /// Force of the grains on a wall, mean over the last step [N/m].
    Vec2 wall_force(int wall, double dt) const;

private:
    double energy_before_ = 0.0;
};

/// Of all grains [N s/m].
Vec2 momentum(const Grains& grains);

/// Of all grains about the origin [N s].
double angular_momentum(const Grains& grains);

}  // namespace polargrain::testing
