#include "src/run/measurements.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace polargrain {

namespace {

/// True where the value is that of the standard observable of the same name.
bool is_standard(const Expectation& expectation) {
    const ObservableSpec& spec = expectation.observable;
    const ObservableEntry* entry = find_observable(spec.quantity);
    const bool whole = !spec.region && !spec.shape && !spec.material && !spec.started_in;
    return entry != nullptr && entry->standard && whole && spec.label.empty() && !expectation.from && !expectation.to &&
           expectation.statistic == Statistic::last;
}

/// Where the memory of a measurement stands in a checkpoint: apart from our own, whatever its label.
std::string memory_of(const std::string& label) { return "measured/" + label; }

}  // namespace

std::vector<std::string> expectation_labels(const std::vector<Expectation>& expectations) {
    std::set<std::string> taken;
    for (const ObservableEntry& entry : observable_table()) {
        if (entry.standard) taken.insert(entry.name);
    }
    std::vector<std::string> labels;
    for (const Expectation& expectation : expectations) {
        const ObservableSpec& spec = expectation.observable;
        std::string label = spec.label.empty() ? spec.quantity : spec.label;
        if (spec.label.empty() && expectation.statistic != Statistic::last)
            label += "_" + to_string(expectation.statistic);
        if (!is_standard(expectation)) {
            const std::string stem = label;
            for (int k = 2; !taken.insert(label).second; ++k) label = stem + "_" + std::to_string(k);
        }
        labels.push_back(std::move(label));
    }
    return labels;
}

Measurements::Measurements(std::vector<Expectation> expectations, double every)
    : expectations_(std::move(expectations)), every_(every) {}

void Measurements::begin(const Scene& scene, const RunInfo& /*info*/) {
    measured_.clear();
    for (const ObservableEntry& entry : observable_table()) {
        if (!entry.standard) continue;
        ObservableSpec spec;
        spec.quantity = entry.name;
        measured_.push_back({entry.name, Observer(spec, scene), Reduction(Statistic::last, {}, {})});
    }
    const std::vector<std::string> labels = expectation_labels(expectations_);
    for (std::size_t k = 0; k < expectations_.size(); ++k) {
        const Expectation& e = expectations_[k];
        if (is_standard(e)) continue;
        measured_.push_back({labels[k], Observer(e.observable, scene), Reduction(e.statistic, e.from, e.to)});
    }
}

void Measurements::save(Checkpoint& checkpoint) {
    checkpoint.put("every", std::vector{every_});
    for (const Measured& m : measured_) {
        checkpoint.put(memory_of(m.label) + "/reduction", m.reduction.state());
        m.observer.save(checkpoint, memory_of(m.label));
    }
}

void Measurements::resume(const Scene& scene, const RunInfo& info, const Checkpoint& saved) {
    begin(scene, info);
    every_ = saved.reals("every").at(0);  // a run that goes on for longer is read as before
    for (Measured& m : measured_) {
        m.reduction.set_state(saved.reals(memory_of(m.label) + "/reduction"));
        m.observer.load(saved, memory_of(m.label));
    }
}

void Measurements::step(const World& world, double dt, const StepReport& report) {
    for (Measured& m : measured_) m.observer.step(world, dt, report);
}

void Measurements::sample(const Sample& sample) {
    for (Measured& m : measured_) m.reduction.add(sample.world.time, m.observer.read(sample));
}

std::map<std::string, double> Measurements::values() const {
    std::map<std::string, double> values;
    for (const Measured& m : measured_) {
        if (std::isfinite(m.reduction.value())) values[m.label] = m.reduction.value();
    }
    return values;
}

double reading_interval(const OutputSettings& output, double duration) {
    return output.series_every > 0.0 ? output.series_every : duration / 100.0;
}

}  // namespace polargrain
