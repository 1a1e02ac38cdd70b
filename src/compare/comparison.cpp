#include "src/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/record/text_file.h"

namespace polargrain {

namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string names_row(const char* first, const std::vector<Quantity>& quantities) {
    std::string row = first;
    for (const Quantity& q : quantities) row += "," + q.name;
    return row + "\n";
}

std::string with_unit(const Quantity& quantity) {
    return quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit);
}

std::string quoted(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "`" : ", `") + word + "`";
    return text;
}

std::string cost_table(const Comparison& comparison) {
    std::string text =
        "| engine | time step [s] | steps | CPU s per simulated s | against " + comparison.engines[0] + " |\n";
    text += "|---|---|---|---|---|\n";
    for (std::size_t e = 0; e < comparison.engines.size(); ++e) {
        const Track& first = comparison.tracks[e].front();
        text += fmt::format("| {} | {:.4g} | {} | {} | x {:.2g} |\n", comparison.engines[e], first.dt, first.steps,
                            to_string(comparison.cost(e)), comparison.cost(e).mean / comparison.cost(0).mean);
    }
    return text;
}

std::string quantity_table(const Comparison& comparison) {
    std::string text = "| quantity | engine | value | verdict |\n|---|---|---|---|\n";
    for (std::size_t q = 0; q < comparison.quantities().size(); ++q) {
        if (comparison.nothing_to_see(q)) continue;
        const Quantity& quantity = comparison.quantities()[q];
        const Spread reference = comparison.spread(0, q);
        for (std::size_t e = 0; e < comparison.engines.size(); ++e) {
            const Spread spread = comparison.spread(e, q);
            text += fmt::format("| {} | {} | {} | {} |\n", e == 0 ? with_unit(quantity) : "", comparison.engines[e],
                                to_string(spread),
                                e == 0 ? "" : to_string(compare_means(reference, spread), quantity.unit));
        }
    }
    return text;
}

}  // namespace

Spread Comparison::spread(std::size_t engine, std::size_t quantity) const {
    std::vector<double> values;
    for (const Track& track : tracks[engine]) values.push_back(track.values[quantity]);
    return spread_of(values);
}

Spread Comparison::spread_at(std::size_t engine, std::size_t quantity, std::size_t tick) const {
    std::vector<double> values;
    for (const Track& track : tracks[engine]) values.push_back(track.readings[tick][quantity]);
    return spread_of(values);
}

Spread Comparison::cost(std::size_t engine) const {
    std::vector<double> costs;
    for (const Track& track : tracks[engine]) costs.push_back(track.cost());
    return spread_of(costs);
}

std::size_t Comparison::ticks() const {
    std::size_t least = tracks.front().front().readings.size();
    for (const auto& of_engine : tracks) {
        for (const Track& track : of_engine) least = std::min(least, track.readings.size());
    }
    return least;
}

bool Comparison::nothing_to_see(std::size_t quantity) const {
    for (const auto& of_engine : tracks) {
        for (const Track& track : of_engine) {
            const double value = track.values[quantity];
            if (std::isfinite(value) && value != 0.0) return false;
        }
    }
    return true;
}

std::string report_text(const Comparison& comparison) {
    std::string text = fmt::format("# {}\n\n{} engines on the same initial states, bit for bit, over {} seed{}. {}\n\n",
                                   comparison.title, comparison.engines.size(), comparison.seeds(),
                                   comparison.seeds() == 1 ? "" : "s", comparison.initial_states);
    text += cost_table(comparison) + "\n";
    text += fmt::format(
        "Values: mean over the seeds +- standard deviation. Verdict: against {}, by Welch's test of the means at 5 %.\n"
        "Overlap: of the whole outlines, by the same exact measure for every engine, at readings every {:.3g} s.\n\n",
        comparison.engines[0], comparison.clock.every);
    text += quantity_table(comparison);
    std::vector<std::string> zero;
    for (std::size_t q = 0; q < comparison.quantities().size(); ++q) {
        if (comparison.nothing_to_see(q)) zero.push_back(comparison.quantities()[q].name);
    }
    if (!zero.empty()) text += fmt::format("\nZero or without value in all runs: {}.\n", quoted(zero));
    for (std::size_t e = 0; e < comparison.engines.size(); ++e) {
        for (const std::string& note : comparison.notes[e])
            text += fmt::format("\n- {}: {}", comparison.engines[e], note);
    }
    while (text.ends_with('\n')) text.pop_back();
    return text + "\n";
}

void write_tables(const Comparison& comparison, const std::filesystem::path& folder) {
    TextFile values(folder / "values.csv");
    TextFile series(folder / "series.csv");
    values.write(
        names_row("engine,seed,time_step,steps,cpu_seconds_per_simulated_second,state_hash", comparison.quantities()));
    series.write(names_row("engine,seed,time", comparison.quantities()));
    for (const auto& of_engine : comparison.tracks) {
        for (const Track& track : of_engine) {
            values.write(fmt::format("{},{},{},{},{},{}", track.engine, track.seed, track.dt, track.steps, track.cost(),
                                     track.state_hash));
            for (const double value : track.values) values.write("," + number(value));
            values.write("\n");
            for (std::size_t tick = 0; tick < track.readings.size(); ++tick) {
                series.write(fmt::format("{},{},{}", track.engine, track.seed,
                                         static_cast<double>(tick) * comparison.clock.every));
                for (const double reading : track.readings[tick]) series.write("," + number(reading));
                series.write("\n");
            }
        }
    }
    values.close();
    series.close();
}

}  // namespace polargrain
