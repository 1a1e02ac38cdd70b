#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/compare/track.h"
#include "src/compare/verdict.h"

namespace polargrain {

/// Several engines on the same initial states.
struct Comparison {
    std::string title;
    std::string initial_states;  ///< a sentence: what differs from seed to seed, and who settled them
    Clock clock;
    std::vector<std::string> engines;             ///< the first is what the others are held against
    std::vector<std::vector<std::string>> notes;  ///< by engine: what it leaves out of the scene
    std::vector<std::vector<Track>> tracks;       ///< by engine, then by seed

    const std::vector<Quantity>& quantities() const { return tracks.front().front().quantities; }
    std::size_t seeds() const { return tracks.front().size(); }
    /// Spread over the seeds of an engine's value of a quantity.
    Spread spread(std::size_t engine, std::size_t quantity) const;
    /// Spread over the seeds of a reading at a tick of the clock.
    Spread spread_at(std::size_t engine, std::size_t quantity, std::size_t tick) const;
    /// CPU seconds per simulated second.
    Spread cost(std::size_t engine) const;
    /// Ticks that all runs have reached.
    std::size_t ticks() const;
    /// Zero, or without value, in all runs.
    bool nothing_to_see(std::size_t quantity) const;
};

/// The comparison in words and tables (Markdown): costs, then each quantity with a verdict for each engine.
std::string report_text(const Comparison& comparison);

/// values.csv: a row for each run: engine, seed, time step, cost, state hash, one number for each quantity.
/// series.csv: a row for each run and tick: engine, seed, time, one reading for each quantity.
/// observables.png, .pdf and .csv: means over the seeds over time with their standard deviations (skipped where nothing
/// has happened). RunError where a file cannot be written, or where there is nothing to plot with.
void write_tables(const Comparison& comparison, const std::filesystem::path& folder);
void write_plots(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace polargrain
