#include "src/compare/meters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/observe/bed.h"
#include "src/observe/deepest_overlap.h"
#include "src/run/measurements.h"
#include "src/run/settle.h"

namespace polargrain {

namespace {

/// A flow has stopped when nothing has come out for this share of the run.
constexpr double k_stopped_share = 0.2;

/// Pairs of bodies among the contacts, which are sorted by pair.
double touching_pairs(const std::vector<Contact>& contacts) {
    double count = 0.0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const bool again = k > 0 && contacts[k].a == contacts[k - 1].a && contacts[k].b == contacts[k - 1].b;
        if (!again) ++count;
    }
    return count;
}

}  // namespace

Meters::Meters(const Scene& scene, const std::vector<Expectation>& expectations,
               const std::vector<ObservableSpec>& observed, double duration)
    : scene_(scene),
      duration_(duration),
      start_potential_(energy(scene.grains, scene.gravity).potential),
      mean_diameter_(2.0 * mean_outer_radius(scene)) {
    add_own("potential_energy_gain_per_grain", "J/m", Statistic::last);
    add_own("touching_pairs", "", Statistic::mean);
    add_own("overlap_percent_of_diameter", "%", Statistic::maximum);
    add_own("flow_stopped", "", Statistic::last);
    add_own("rest_energy", "", Statistic::last);
    add("kinetic_energy_per_grain", Statistic::mean);
    add("centre_of_mass_x", Statistic::last);
    add("centre_of_mass_y", Statistic::last);
    add("grains_out", Statistic::last);
    add("moves_rejected_percent", Statistic::last);
    add("energy_created_ratio", Statistic::last);
    const std::vector<std::string> labels = expectation_labels(expectations);
    for (std::size_t k = 0; k < labels.size(); ++k) {
        const Expectation& e = expectations[k];
        add(e.observable, Reduction(e.statistic, e.from, e.to), labels[k]);
    }
    for (const ObservableSpec& spec : observed) {
        add(spec, Reduction(Statistic::last, {}, {}), spec.label.empty() ? spec.quantity : spec.label);
    }
}

void Meters::add_own(const std::string& name, const std::string& unit, Statistic statistic) {
    quantities_.push_back({name, unit});
    reductions_.emplace_back(statistic, std::nullopt, std::nullopt);
}

void Meters::add(const std::string& quantity, Statistic statistic) {
    ObservableSpec spec;
    spec.quantity = quantity;
    add(spec, Reduction(statistic, {}, {}), quantity);
}

void Meters::add(const ObservableSpec& spec, const Reduction& reduction, const std::string& name) {
    // The overlap is among our own, as a share of the diameter.
    if (spec.quantity == "deepest_overlap" || std::ranges::count(quantities_, name, &Quantity::name) > 0) return;
    observers_.emplace_back(spec, scene_);
    const std::string unit = units_of(observers_.back().entry().dimension).front();
    quantities_.push_back({name, unit == "1" ? "" : unit});
    reductions_.push_back(reduction);
}

void Meters::step(const World& world, double dt, const StepReport& report) {
    for (Observer& observer : observers_) observer.step(world, dt, report);
}

/// 1 where grains have come out and others are still in, but none has come out for a while.
double Meters::stopped(const Sample& sample) {
    const GrainIndex out = count_out(scene_, sample.world.grains);
    if (out != std::exchange(out_, out)) last_exit_ = sample.world.time;
    const bool flows = out < sample.world.grains.size() && out > 0;
    return flows && sample.world.time - last_exit_ >= k_stopped_share * duration_ ? 1.0 : 0.0;
}

std::vector<double> Meters::read(const Sample& sample) {
    const Grains& grains = sample.world.grains;
    const double count = std::max(1.0, static_cast<double>(grains.size()));
    std::vector<double> readings{
        (energy(grains, scene_.gravity).potential - start_potential_) / count,
        touching_pairs(sample.report.contacts),
        100.0 * deepest_overlap(scene_, sample.world) / mean_diameter_,
        stopped(sample),
        rest_energy(scene_, grains),
    };
    for (Observer& observer : observers_) readings.push_back(observer.read(sample));
    for (std::size_t q = 0; q < readings.size(); ++q) reductions_[q].add(sample.world.time, readings[q]);
    return readings;
}

std::vector<double> Meters::values() const {
    std::vector<double> values;
    for (const Reduction& reduction : reductions_) values.push_back(reduction.value());
    return values;
}

}  // namespace polargrain
