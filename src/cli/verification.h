#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/model/settings.h"

namespace polargrain {

/// What came of one expectation, in its own unit.
struct ExpectationResult {
    std::string label;
    std::string unit;
    std::optional<double> min, max;
    std::string source;
    std::vector<double> measured;  ///< one per run that gave a value
    std::size_t runs = 0;

    double mean() const;    ///< NaN where no run gave a value
    double spread() const;  ///< standard deviation of a single run; zero for one run
    /// Every run gave a value, and their mean lies in the band.
    bool holds() const;
};

/// The findings of one scenario.
struct Verification {
    std::string name;
    std::string title;
    std::vector<ExpectationResult> findings;
    int runs = 0;
    int restless = 0;  ///< runs whose grains were not yet at rest at time zero, though asked to come to it

    bool holds() const;
};

/// One finding for each expectation of the scenario, without any measurement yet.
Verification begin_verification(const std::string& name, const Scenario& scenario);

/// Adds what the summary.json of a run of that scenario says. InputError where it cannot be read.
void add_run(Verification& verification, const Scenario& scenario, const std::filesystem::path& folder);

/// A table for people: quantity, measured, band, verdict and source.
std::string verification_table(const Verification& verification);

/// The same for programs: a header line and a line for each finding.
std::string verification_csv(const std::vector<Verification>& verifications);

}  // namespace polargrain
