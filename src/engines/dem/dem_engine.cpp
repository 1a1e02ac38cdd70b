#include "src/engines/dem/dem_engine.h"

#include <algorithm>
#include <cmath>

#include "src/engines/dem/integrators.h"
#include "src/engines/dem/soft_ledger.h"
#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

class DemEngine final : public Engine {
public:
    DemEngine(const Scene& scene, const DemSettings& settings)
        : scene_(scene),
          system_(scene, settings),
          integrator_(make_integrator(settings.integrator)),
          longest_part_(system_.shortest_contact() / settings.resolution) {}

    std::string_view name() const override { return "dem"; }
    double suggested_dt() const override { return critical_time_step(scene_); }
    double parts_of_step(double dt) const override { return std::max(1.0, std::ceil(dt / longest_part_ - 1e-9)); }

    void step(World& world, double dt, StepReport& report) override {
        report.clear(scene_.walls.size());
        system_.set_step(world.step);
        read(world);
        const StoredEnergy stored_before = stored_energy(system_);
        const double energy_before = energy(world.grains, scene_.gravity).total();
        for (SoftContact& c : system_.contacts()) c.impulse = Vec2::Zero();

        const auto parts = static_cast<std::int64_t>(parts_of_step(dt));
        const double h = dt / static_cast<double>(parts);
        account_rates(system_, state_.x, state_.v, 0.5 * h, report);
        for (std::int64_t part = 0; part < parts; ++part) {
            state_.time = world.time + static_cast<double>(part) * h;
            std::visit([&](auto& scheme) { scheme.step(system_, state_, h); }, integrator_);
            account_losses(system_, report);
            account_rates(system_, state_.x, state_.v, part + 1 == parts ? 0.5 * h : h, report);
        }
        write(world);
        ++world.step;
        world.time = static_cast<double>(world.step) * dt;
        finish_report(world, energy_before, stored_before, report);
    }

    void save(Checkpoint& checkpoint) const override {
        system_.save(checkpoint);
        checkpoint.put("dem/accelerations", state_.a);
        std::visit([&](const auto& scheme) { checkpoint.put("dem/integrator", scheme.memory); }, integrator_);
    }

    void load(const Checkpoint& checkpoint) override {
        system_.load(checkpoint);
        state_.a = checkpoint.reals("dem/accelerations");
        std::visit([&](auto& scheme) { scheme.memory = checkpoint.reals("dem/integrator"); }, integrator_);
    }

private:
    /// The world decides where grains are; accelerations are kept from the step before.
    void read(const World& world) {
        const Grains& grains = world.grains;
        const std::size_t n = system_.size();
        state_.time = world.time;
        state_.x.resize(n);
        state_.v.resize(n);
        for (std::size_t k = 0; k < grains.x.size(); ++k) {
            state_.x[3 * k] = grains.x[k];
            state_.x[3 * k + 1] = grains.y[k];
            state_.x[3 * k + 2] = grains.angle[k];
            state_.v[3 * k] = grains.vx[k];
            state_.v[3 * k + 1] = grains.vy[k];
            state_.v[3 * k + 2] = grains.spin[k];
        }
        system_.set_accepted(state_.time, state_.x);
        if (state_.a.size() == n) return;
        state_.a.assign(n, 0.0);
        system_.accelerations(state_.time, state_.x, state_.v, state_.a);
        system_.accept(state_.time, state_.x);
    }

    void write(World& world) const {
        Grains& grains = world.grains;
        for (std::size_t k = 0; k < grains.x.size(); ++k) {
            grains.x[k] = state_.x[3 * k];
            grains.y[k] = state_.x[3 * k + 1];
            grains.angle[k] = state_.x[3 * k + 2];
            grains.vx[k] = state_.v[3 * k];
            grains.vy[k] = state_.v[3 * k + 1];
            grains.spin[k] = state_.v[3 * k + 2];
        }
    }

    void finish_report(const World& world, double energy_before, const StoredEnergy& stored_before,
                       StepReport& report) const {
        for (const SoftContact& c : system_.contacts()) {
            report.contacts.push_back({c.a, c.b, c.point, c.normal, -c.depth, c.impulse});
        }
        report.moves.tried = world.grains.size();
        EnergyLedger& ledger = report.ledger;
        const StoredEnergy stored = stored_energy(system_);
        ledger.stored = stored.total() - stored_before.total();
        ledger.friction_loss -= stored.sliding - stored_before.sliding;
        // What the scheme itself makes of energy: all that has no other cause.
        ledger.created = energy(world.grains, scene_.gravity).total() - energy_before + ledger.stored -
                         ledger.wall_work + ledger.restitution_loss + ledger.friction_loss;
        ledger.rises = std::max(0.0, ledger.created);
    }

    const Scene& scene_;
    SoftSystem system_;
    Integrator integrator_;
    double longest_part_;  ///< [s]
    SchemeState state_;
};

}  // namespace

std::unique_ptr<Engine> make_dem(const Scene& scene, const DemSettings& settings) {
    return std::make_unique<DemEngine>(scene, settings);
}

}  // namespace polargrain
