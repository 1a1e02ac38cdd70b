#include "src/cli/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/reader.h"
#include "src/core/error.h"
#include "src/observe/observable_table.h"
#include "src/record/summary_reader.h"
#include "src/record/text_file.h"
#include "src/run/measurements.h"

namespace polargrain {

namespace {

constexpr const char* k_falls_short = "FALLS SHORT";

std::string measured_text(const ExpectationResult& finding) {
    if (finding.measured.empty()) return "no value";
    std::string text = fmt::format("{:.4g}", finding.mean());
    if (finding.runs > 1) text += fmt::format(" +- {:.3g}", finding.spread());
    if (finding.measured.size() < finding.runs) {
        text += fmt::format(" ({} of {} runs)", finding.measured.size(), finding.runs);
    }
    return text;
}

std::string band_text(const ExpectationResult& finding) {
    if (finding.min && finding.max) return fmt::format("{:.4g} to {:.4g}", *finding.min, *finding.max);
    return finding.min ? fmt::format(">= {:.4g}", *finding.min) : fmt::format("<= {:.4g}", *finding.max);
}

std::string number_or_nothing(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

}  // namespace

double ExpectationResult::mean() const {
    double sum = 0.0;
    for (const double value : measured) sum += value;
    return measured.empty() ? std::nan("") : sum / static_cast<double>(measured.size());
}

double ExpectationResult::spread() const {
    if (measured.size() < 2) return 0.0;
    double squares = 0.0;
    for (const double value : measured) squares += (value - mean()) * (value - mean());
    return std::sqrt(squares / static_cast<double>(measured.size() - 1));
}

bool ExpectationResult::holds() const {
    if (measured.empty() || measured.size() < runs) return false;
    return (!min || mean() >= *min) && (!max || mean() <= *max);
}

bool Verification::holds() const { return std::ranges::all_of(findings, &ExpectationResult::holds); }

Verification begin_verification(const std::string& name, const Scenario& scenario) {
    Verification verification{.name = name, .title = scenario.title, .findings = {}};
    const std::vector<std::string> labels = expectation_labels(scenario.expectations);
    for (std::size_t k = 0; k < labels.size(); ++k) {
        const Expectation& e = scenario.expectations[k];
        const Dimension dimension = find_observable(e.observable.quantity)->dimension;
        const std::string unit = e.unit.empty() ? units_of(dimension).front() : e.unit;
        verification.findings.push_back({labels[k], unit, e.min, e.max, e.source, {}, 0});
    }
    return verification;
}

void add_run(Verification& verification, const Scenario& scenario, const std::filesystem::path& folder) {
    const StoredSummary summary = read_summary(folder);
    verification.runs += 1;
    if (!summary.at_rest.value_or(true)) verification.restless += 1;
    // Units such as d and m are those of its own grains, which another seed has drawn otherwise.
    const Scene scene = load_scenario(folder / "scenario.toml", {}).scene;
    for (std::size_t k = 0; k < verification.findings.size(); ++k) {
        const Expectation& e = scenario.expectations[k];
        ExpectationResult& finding = verification.findings[k];
        finding.runs += 1;
        const auto value = summary.observables.find(finding.label);
        if (value == summary.observables.end()) continue;
        const Dimension dimension = find_observable(e.observable.quantity)->dimension;
        finding.measured.push_back(value->second / unit_scale(dimension, e.unit, scene).value());
    }
}

std::string verification_table(const Verification& verification) {
    std::size_t name_width = 8, measured_width = 8, band_width = 4;
    for (const ExpectationResult& f : verification.findings) {
        name_width = std::max(name_width, f.label.size() + f.unit.size() + 3);
        measured_width = std::max(measured_width, measured_text(f).size());
        band_width = std::max(band_width, band_text(f).size());
    }
    std::string text = fmt::format("{}: {}\n", verification.name, verification.title);
    const auto row = [&](const std::string& name, const std::string& measured, const std::string& band,
                         const std::string& verdict, const std::string& source) {
        text += fmt::format("  {:<{}}  {:>{}}  {:<{}}  {:<11}  {}\n", name, name_width, measured, measured_width, band,
                            band_width, verdict, source);
    };
    row("quantity", "measured", "band", "", "source");
    for (const ExpectationResult& f : verification.findings) {
        row(fmt::format("{} [{}]", f.label, f.unit), measured_text(f), band_text(f), f.holds() ? "ok" : k_falls_short,
            f.source);
    }
    if (verification.restless > 0) {
        text += fmt::format("  note: the grains of {} of {} runs were not yet at rest at time zero\n",
                            verification.restless, verification.runs);
    }
    return text;
}

std::string verification_csv(const std::vector<Verification>& verifications) {
    std::string text = "scenario,quantity,unit,measured,spread,runs,min,max,verdict,source\n";
    for (const Verification& verification : verifications) {
        for (const ExpectationResult& f : verification.findings) {
            text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_field(verification.name), csv_field(f.label),
                                csv_field(f.unit), f.mean(), f.spread(), f.runs, number_or_nothing(f.min),
                                number_or_nothing(f.max), f.holds() ? "ok" : k_falls_short, csv_field(f.source));
        }
    }
    return text;
}

}  // namespace polargrain
