#include "tests/support/running.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polargrain::testing {

Running::Running(MakeEngine make, Scene the_scene)
    : scene(std::move(the_scene)), engine(make(scene)), world(initial_world(scene)) {
    start_energy = total_energy();
    energy_before_ = start_energy;
}

void Running::step(double dt) {
    engine->step(world, dt, report);
    const EnergyLedger& l = report.ledger;
    const double after = total_energy();
    const double explained = l.wall_work + l.correction + l.created - l.restitution_loss - l.friction_loss - l.stored;
    ledger_error = std::max(ledger_error, std::abs(after - energy_before_ - explained));
    energy_before_ = after;
    moves += report.moves;
    ledger += l;
    impacts += report.impacts;
}

double Running::weight() const {
    const auto& mass = world.grains.mass;
    return std::accumulate(mass.begin(), mass.end(), 0.0) * scene.gravity.norm();
}

double Running::restlessness(double length) const {
    return energy(world.grains, scene.gravity).kinetic() / (weight() * length);
}

double Running::rejected_share() const {
    return moves.tried == 0 ? 0.0 : static_cast<double>(moves.rejected) / static_cast<double>(moves.tried);
}

Vec2 Running::wall_force(int wall, double dt) const { return report.walls[static_cast<std::size_t>(wall)].linear / dt; }

Vec2 momentum(const Grains& grains) {
    Vec2 sum = Vec2::Zero();
    for (GrainIndex k = 0; k < grains.size(); ++k) sum += grains.mass[Grains::at(k)] * grains.velocity(k);
    return sum;
}

double angular_momentum(const Grains& grains) {
    double sum = 0.0;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const std::size_t i = Grains::at(k);
        sum += grains.mass[i] * cross(grains.position(k), grains.velocity(k)) + grains.inertia[i] * grains.spin[i];
    }
    return sum;
}

}  // namespace polargrain::testing
