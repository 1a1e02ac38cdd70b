#include "src/reproduce/mixer_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain {

namespace {

constexpr double k_mm = 1e3, k_cm = 1e2;
constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t at(char set) { return static_cast<std::size_t>(set - 'A'); }

Finding held(std::string quantity, double measured, std::pair<double, double> band, std::string unit,
             std::string against, std::string why = "") {
    return {k_mixer_engine, std::move(quantity), measured,           band.first,
            band.second,    std::move(unit),     std::move(against), std::move(why)};
}

constexpr std::pair k_same_order{0.5, 1.0};  // rank correlations that count as agreement

void add_orders(std::vector<Finding>& findings, const std::vector<MixerSetRuns>& sets) {
    for (const MixerQuantity& quantity : mixer_quantities()) {
        const double r = same_order(quantity.order, means_of_sets(sets, quantity.of));
        if (!std::isfinite(r)) continue;
        findings.push_back(held("order of the sets, rank correlation: " + quantity.name, r, k_same_order, "",
                                "[K02]: " + quantity.words, quantity.why_not));
    }
    const MixerRow off = speed_differences(sets);
    findings.push_back(held("speeds, cell by cell, of A in its two seeds: mean difference", 100.0 * off.front(),
                            {0.0, 10.0}, "%", "what cannot be told apart"));
    findings.push_back(held("order of the sets, rank correlation: speeds off those of A",
                            same_order(mixer_speed_order(), off), k_same_order, "",
                            "[K02, sec. 4.2]: off the measured ones"));
}

constexpr const char* k_no_hold =
    "in the mixer friction at the wall keeps the bed by the join while it divides; in the plane nothing presses it "
    "there";

void add_exchange(std::vector<Finding>& findings, const std::vector<MixerSetRuns>& sets) {
    const MixerRow exchange = means_of_sets(sets, [](const MixerRun& r) { return r.exchange; });
    const MixerRow dividing = means_of_sets(sets, [](const MixerRun& r) { return r.exchange_dividing; });
    const auto over_a = [&](char set, std::pair<double, double> band, const std::string& words,
                            const std::string& why = "") {
        findings.push_back(held(fmt::format("exchange of {} over that of A", set),
                                exchange[at(set)] / exchange[at('A')], band, "", "[K02, sec. 4.3]: " + words, why));
    };
    findings.push_back(held("exchange of A", exchange[at('A')], {0.02, 0.18}, "per turn",
                            "the axis of [K02, Fig. 12], which leaves out E"));
    over_a('E', {3.0, 30.0}, "about ten times");
    over_a('G', {1.1, 10.0}, "much greater");
    over_a('H', {0.0, 0.9}, "much smaller",
           std::string("grains on a smooth wall arrive faster here, and scatter farther; ") + k_no_hold);
    over_a('D', {1.05, 10.0}, "higher", k_no_hold);
    findings.push_back(held("exchange of A, share while dividing", dividing[at('A')], {0.5, 1.0}, "",
                            "[K02, Fig. 13]: the larger one",
                            "here the bed lifts off the join as a whole and falls in two, which hardly touch; in the "
                            "mixer it slides off over the join"));
    findings.push_back(held("the same of H over that of A", dividing[at('H')] / dividing[at('A')], {0.0, 0.8}, "",
                            "[K02, Fig. 13a]: much smaller", k_no_hold));
}

void add_motion(std::vector<Finding>& findings, const std::vector<MixerSetRuns>& sets) {
    const MixerRow speed = means_of_sets(sets, [](const MixerRun& r) { return r.speed; });
    const MixerRow circulation = means_of_sets(sets, [](const MixerRun& r) { return r.circulation; });
    findings.push_back(held("speed of B over that of A", speed[at('B')] / speed[at('A')], {0.97, 1.03}, "",
                            "[K02, sec. 4.1]: no difference"));
    findings.push_back(
        held("speed of C over that of A", speed[at('C')] / speed[at('A')], {0.0, 1.0}, "", "[K02, sec. 4.1]: slower"));
    findings.push_back(held("circulation time of A over the period", circulation[at('A')] * k_mixer_rate / 60.0,
                            {0.3, 1.5}, "", "[K02, Fig. 14]: of the order of the period"));
    double apart = 1.0;
    for (const char set : {'B', 'C', 'D', 'F', 'G', 'H'}) {
        apart =
            std::max({apart, circulation[at(set)] / circulation[at('A')], circulation[at('A')] / circulation[at(set)]});
    }
    findings.push_back(held("circulation time, all but E: largest ratio to that of A", apart, {1.0, 2.0}, "",
                            "[K02, Fig. 14]: of one order"));
}

/// Whether the circulation time gets longer at each slower speed.
bool rises_with_the_period(const MixerSetRuns& set) {
    return std::ranges::is_sorted(set.by_rate, std::ranges::greater{}, &MixerRun::circulation);
}

void add_rates(std::vector<Finding>& findings, const std::vector<MixerSetRuns>& sets) {
    const auto rising = std::ranges::count_if(sets, rises_with_the_period);
    const bool e_rises = rises_with_the_period(sets[at('E')]);
    findings.push_back(held("sets but E whose circulation time rises with the period",
                            static_cast<double>(rising - (e_rises ? 1 : 0)), {7.0, 7.0}, "", "[K02, sec. 4.4]: all"));
    findings.push_back(held("the same of E, 1 for yes", e_rises ? 1.0 : 0.0, {0.0, 0.0}, "", "[K02, sec. 4.4]: no",
                            "it rises by less than a tenth over twice the period, where the others rise by four "
                            "fifths"));
}

}  // namespace

const std::vector<MixerQuantity>& mixer_quantities() {
    static const std::vector<MixerQuantity> all{
        {"mean speed [mm/s]", "speed_mm_s", [](const MixerRun& r) { return k_mm * r.speed; },
         MixerRow{2, 2, 1, 1, 3, 2, 3, 3},
         "E, G, H faster, by the walls; D, C slower: C travels slower than A, D has less of fast grains [sec. 4.1, "
         "4.2, "
         "Figs. 9, 10]"},
        {"granular temperature [cm²/s²]", "temperature_cm2_s2",
         [](const MixerRun& r) { return k_cm * k_cm * r.temperature; }, MixerRow{1, 1, 1, 1, 2, 1, 1, 1},
         "E apart, the others alike [sec. 4.2, Fig. 11]"},
        {"exchange between the arms [per turn]", "exchange_per_turn", [](const MixerRun& r) { return r.exchange; },
         MixerRow{2, 2, 2, 3, 5, 2, 4, 1}, "E ten times the others, then G, then D; H least [sec. 4.3, Figs. 12, 13]",
         "F and H are faster than A here, and scatter over the join"},
        {"circulation time [s]", "circulation_time_s", [](const MixerRun& r) { return r.circulation; },
         MixerRow{k_none, k_none, k_none, k_none, k_none, k_none, k_none, k_none},
         "of one order, but for E; not ranked [sec. 4.4, Fig. 14]"},
        {"dispersion, combining [mm²/s]", "dispersion_combining_mm2_s",
         [](const MixerRun& r) { return k_mm * k_mm * r.dispersion_combining; }, MixerRow{1, 1, 2, 2, 3, 1, 1, 1},
         "E apart; C and D more than A; B, F as A; G elsewhere [sec. 4.5, Fig. 15]",
         "[K02] speaks of places in its maps; the mean over all cells goes with the speed"},
        {"dispersion, dividing [mm²/s]", "dispersion_dividing_mm2_s",
         [](const MixerRun& r) { return k_mm * k_mm * r.dispersion_dividing; }, MixerRow{1, 1, 1, 2, 3, 1, 2, 2},
         "E apart; D more by the join, G and H at the ends; B as A [sec. 4.5, Fig. 16]"},
    };
    return all;
}

const MixerRow& mixer_speed_order() {
    static const MixerRow order{k_none, 1, 2, 2, 3, 1, 4, 4};
    return order;
}

MeanSpread over_seeds(const MixerSetRuns& set, double (*of)(const MixerRun&)) {
    std::vector<double> values;
    for (const MixerRun& run : set.runs) values.push_back(of(run));
    return mean_and_spread(values);
}

MixerRow means_of_sets(const std::vector<MixerSetRuns>& sets, double (*of)(const MixerRun&)) {
    MixerRow row{};
    std::ranges::transform(sets, row.begin(), [&](const MixerSetRuns& set) { return over_seeds(set, of).mean; });
    return row;
}

MixerRow speed_differences(const std::vector<MixerSetRuns>& sets) {
    const MixerSetRuns& a = sets.front();
    MixerRow row{};
    std::ranges::transform(sets, row.begin(),
                           [&](const MixerSetRuns& set) { return speed_difference(set.cells, a.cells); });
    row.front() = speed_difference(a.runs.front().cells, a.runs.back().cells);
    return row;
}

double same_order(const MixerRow& a, const MixerRow& b) {
    return rank_correlation({a.begin(), a.end()}, {b.begin(), b.end()});
}

std::vector<Finding> mixer_findings(const std::vector<MixerSetRuns>& sets) {
    std::vector<Finding> findings;
    add_orders(findings, sets);
    add_exchange(findings, sets);
    add_motion(findings, sets);
    add_rates(findings, sets);
    return findings;
}

}  // namespace polargrain
