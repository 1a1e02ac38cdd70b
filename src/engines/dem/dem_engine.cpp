#include "src/engines/dem/dem_engine.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "src/engines/dem/integrators.h"
#include "src/engines/dem/soft_ledger.h"
#include "src/engines/dem/soft_system.h"

namespace polargrain {

namespace {

/// After how many steps the engine looks whether its numbers still follow where grains are: mixing takes longer.
constexpr std::int64_t k_look_every = 8;

double mean_diameter(const Scene& scene) {
    double sum = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) sum += 2.0 * outer_radius(scene.shape_of(k));
    return sum / static_cast<double>(scene.grains.size());
}

class DemEngine final : public Engine {
public:
    DemEngine(const Scene& scene, const DemSettings& settings)
        : scene_(scene),
          system_(scene, settings),
          integrator_(make_integrator(settings.integrator)),
          longest_part_(system_.longest_step()),
          stiffest_when_light_(settings.polygons == PolygonContact::area && settings.area_exponent < 2.0) {}

    std::string_view name() const override { return "dem"; }
    std::vector<std::string> notes() const override {
        std::vector<std::string> all{
            "contacts last for many steps and are not impacts one by one: impacts.csv would stay empty"};
        if (stiffest_when_light_) {
            all.emplace_back(
                "dem.area_exponent is below 2: lightly pressed faces are stiffer than steps allow for, without limit; "
                "look at energy_created");
        }
        return all;
    }
    double suggested_dt() const override { return critical_time_step(scene_); }
    double parts_of_step(double dt) const override { return std::max(1.0, std::ceil(dt / longest_part_ - 1e-9)); }

    void step(World& world, double dt, StepReport& report) override {
        report.clear(scene_.walls.size());
        const auto parts = static_cast<std::int64_t>(parts_of_step(dt));
        const double h = dt / static_cast<double>(parts);
        system_.set_step(world.step, h);
        if (world.step % k_look_every == 0 && system_.is_scattered()) renumber(world.grains);
        read(world);
        const StoredEnergy stored_before = system_.turnover().stored;
        const double on_loan_before = on_loan(world.grains, h);
        const double energy_before = energy(world.grains, scene_.gravity).total();

        account(Instant::first, h, report);
        for (std::int64_t part = 0; part < parts; ++part) {
            state_.time = world.time + static_cast<double>(part) * h;
            std::visit([&](auto& scheme) { scheme.step(system_, state_, h); }, integrator_);
            account_losses(system_, report);
            system_.add_ended(ended_);
            account(part + 1 == parts ? Instant::last : Instant::inner, h, report);
        }
        write(world);
        ++world.step;
        world.time = static_cast<double>(world.step) * dt;
        report.ledger.stored = on_loan_before - on_loan(world.grains, h);
        report_contacts(0.5 * h, report);
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
    void renumber(const Grains& grains) {
        const Numbering before = system_.numbers();
        system_.renumber(numbers_by_rows(grains, mean_diameter(scene_)));
        move_coordinates(before, system_.numbers(), state_.a);
        std::visit([&](auto& scheme) { move_coordinates(before, system_.numbers(), scheme.memory); }, integrator_);
    }

    /// The world decides where grains are; accelerations are kept from the step before.
    void read(const World& world) {
        const Grains& grains = world.grains;
        const std::size_t n = system_.size();
        state_.time = world.time;
        state_.x.resize(n);
        state_.v.resize(n);
        for (std::size_t k = 0; k < n / 3; ++k) {
            const std::size_t grain = Grains::at(system_.numbers()[k]);
            state_.x[3 * k] = grains.x[grain];
            state_.x[3 * k + 1] = grains.y[grain];
            state_.x[3 * k + 2] = grains.angle[grain];
            state_.v[3 * k] = grains.vx[grain];
            state_.v[3 * k + 1] = grains.vy[grain];
            state_.v[3 * k + 2] = grains.spin[grain];
        }
        system_.set_accepted(state_.time, state_.x);
        if (state_.a.size() == n) return;
        state_.a.assign(n, 0.0);
        system_.accelerations(state_.time, state_.x, state_.v, state_.a);
        system_.accept(state_.time, state_.x);
    }

    enum class Instant : std::uint8_t { first, inner, last };

    /// Books what contacts do during the half steps next to an instant, with the velocities of these: under kick, drift
    /// and kick those of the step after the first instant, of the one before the last, and their mean in between.
    void account(Instant instant, double h, StepReport& report) {
        const double weight = instant == Instant::inner ? h : 0.5 * h;
        system_.weigh(weight);
        if (!kicks()) {
            account_rates(system_, state_.x, state_.v, weight, report);
            return;
        }
        kept_.clear();
        if (instant != Instant::first) take_back_balance(instant == Instant::last ? 1.0 : 0.5);
        if (instant == Instant::inner) {
            account_rates(system_, state_.x, state_.v, weight, report);
        } else {
            at_work_ = state_.v;
            const double kick = instant == Instant::first ? 0.5 * h : -0.5 * h;
            for (std::size_t k = 0; k < at_work_.size(); ++k) at_work_[k] += kick * state_.a[k];
            account_rates(system_, state_.x, at_work_, weight, report);
        }
        for (std::size_t n = kept_.size(); n-- > 0;) state_.v[kept_[n].first] = kept_[n].second;
    }

    /// A share of what SoftSystem::balance_work did to the velocities, until they are put back from `kept_`.
    void take_back_balance(double share) {
        for (const auto& [grain, of] : system_.balance().changes) {
            const std::size_t k = 3 * Grains::at(grain);
            const double change[] = {of.velocity.x(), of.velocity.y(), of.spin};
            for (std::size_t d = 0; d < 3; ++d) {
                kept_.emplace_back(k + d, state_.v[k + d]);
                state_.v[k + d] -= share * change[d];
            }
        }
    }

    bool kicks() const { return std::holds_alternative<VelocityVerlet>(integrator_); }

    /// By how much the kinetic energy of velocities at whole steps of kick, drift and kick exceeds that of the half
    /// steps around them, m v- v+ / 2: h^2 sum m a^2 / 8 [J/m]. Springs lend it while they push.
    double on_loan(const Grains& grains, double h) const {
        if (!kicks()) return 0.0;
        double sum = 0.0;
        for (std::size_t k = 0; k < grains.x.size(); ++k) {
            const Vec2 linear(state_.a[3 * k], state_.a[3 * k + 1]);
            const double angular = state_.a[3 * k + 2];
            const std::size_t grain = Grains::at(system_.numbers()[k]);
            sum += grains.mass[grain] * linear.squaredNorm() + grains.inertia[grain] * angular * angular;
        }
        return 0.125 * h * h * sum;
    }

    void write(World& world) const {
        Grains& grains = world.grains;
        for (std::size_t k = 0; k < grains.x.size(); ++k) {
            const std::size_t grain = Grains::at(system_.numbers()[k]);
            grains.x[grain] = state_.x[3 * k];
            grains.y[grain] = state_.x[3 * k + 1];
            grains.angle[grain] = state_.x[3 * k + 2];
            grains.vx[grain] = state_.v[3 * k];
            grains.vy[grain] = state_.v[3 * k + 1];
            grains.spin[grain] = state_.v[3 * k + 2];
        }
    }

    /// Under the scene's numbers, sorted by them: what touches, and what has pushed in the step but has ended.
    /// `weight`: for how long the forces at the end have acted [s].
    void report_contacts(double weight, StepReport& report) {
        std::vector<SoftContact>& touching = system_.contacts();
        const auto number = [&](BodyIndex body) { return is_wall(body) ? body : system_.numbers()[Grains::at(body)]; };
        pairs_.clear();
        for (const SoftContact& c : touching) pairs_.push_back(std::minmax({number(c.a), number(c.b)}));
        for (const SoftContact& c : ended_) pairs_.push_back(std::minmax({number(c.a), number(c.b)}));
        for (const std::uint32_t k : sorter_.sort(pairs_, scene_.walls.size(), scene_.grains.x.size())) {
            const bool touches = k < touching.size();
            SoftContact& c = touches ? touching[k] : ended_[k - touching.size()];
            const double sign = number(c.a) == pairs_[k].first ? 1.0 : -1.0;
            if (touches) c.impulse += weight * c.force();
            report.contacts.push_back({pairs_[k].first, pairs_[k].second, c.point, sign * c.normal,
                                       touches ? -c.depth : 0.0, sign * c.impulse});
            c.impulse = Vec2::Zero();
        }
        ended_.clear();
    }

    void finish_report(const World& world, double energy_before, const StoredEnergy& stored_before,
                       StepReport& report) const {
        report.moves.tried = world.grains.size();
        EnergyLedger& ledger = report.ledger;
        const StoredEnergy& stored = system_.turnover().stored;
        ledger.stored += stored.total() - stored_before.total();
        ledger.friction_loss -= stored.sliding - stored_before.sliding;
        // What the scheme itself makes of energy: all that has no other cause.
        ledger.created = energy(world.grains, scene_.gravity).total() - energy_before + ledger.stored -
                         ledger.wall_work + ledger.restitution_loss + ledger.friction_loss;
        ledger.rises = std::max(0.0, ledger.created);
    }

    const Scene& scene_;
    SoftSystem system_;
    Integrator integrator_;
    double longest_part_;       ///< [s]
    bool stiffest_when_light_;  ///< of two polygons' faces, or one's on a wall
    SchemeState state_;
    std::vector<SoftContact> ended_;       ///< in the step at hand
    std::vector<PairSorter::Pair> pairs_;  ///< of the contacts, under the scene's numbers
    PairSorter sorter_;
    std::vector<double> at_work_;                       ///< velocities of a half step
    std::vector<std::pair<std::size_t, double>> kept_;  ///< index and value of velocities set aside
};

}  // namespace

std::unique_ptr<Engine> make_dem(const Scene& scene, const DemSettings& settings) {
    return std::make_unique<DemEngine>(scene, settings);
}

}  // namespace polargrain
