#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/plot/plot.h"
#include "src/record/text_file.h"
#include "src/reproduce/mixer_pictures.h"
#include "src/reproduce/mixer_verdicts.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {

namespace {

std::string set_name(std::size_t s) { return {k_mixer_sets[s].name}; }

std::string number(double value) { return fmt::format("{:.4g}", value); }
std::string two_decimals(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "none"; }

/// "349 ± 11": the mean with three digits, the spread with as many decimals.
std::string with_spread(const MeanSpread& m) {
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(std::abs(m.mean)))));
    return fmt::format("{:.{}f} ± {:.{}f}", m.mean, decimals, m.spread, decimals);
}

/// Bars as high as those of all sets but E need; what goes beyond is cut off and has its number written in.
Panel bars_panel(const MixerQuantity& quantity, const std::vector<MixerSetRuns>& sets) {
    Panel panel{.title = quantity.name,
                .x_range = std::pair{0.4, static_cast<double>(k_mixer_sets.size()) + 0.6},
                .key = KeyPlace::none};
    Series bars{.style = SeriesStyle::bars, .colour = 0};
    double most = 0.0;
    for (std::size_t s = 0; s < k_mixer_sets.size(); ++s) {
        const MeanSpread m = over_seeds(sets[s], quantity.of);
        bars.x.push_back(static_cast<double>(s) + 1.0);
        bars.y.push_back(m.mean);
        bars.y_error.push_back(m.spread);
        panel.x_names.push_back(set_name(s));
        if (k_mixer_sets[s].name != 'E') most = std::max(most, m.mean + m.spread);
    }
    const double top = 1.3 * most;
    panel.y_range = std::pair{0.0, top};
    Series beyond{.style = SeriesStyle::labels, .colour = 6};
    for (std::size_t s = 0; s < k_mixer_sets.size(); ++s) {
        if (bars.y[s] <= top) continue;
        beyond.x.push_back(bars.x[s]);
        beyond.y.push_back(0.93 * top);
        beyond.texts.push_back(number(bars.y[s]));
    }
    panel.series = {std::move(bars), std::move(beyond)};
    return panel;
}

FigureTable table_of_sets(const std::vector<MixerSetRuns>& sets) {
    FigureTable table{
        fmt::format("The sets of [K02, Table 2] and what comes out, mean of {} seeds ± their spread", k_mixer_seeds),
        {"set", "e", "μ", "μ wall", "k [N/m]"},
        {}};
    for (const MixerQuantity& quantity : mixer_quantities()) table.header.push_back(quantity.name);
    table.header.insert(table.header.end(), {"exchange while dividing [%]", "speeds off those of A [%]"});
    const MixerRow off = speed_differences(sets);
    for (std::size_t s = 0; s < k_mixer_sets.size(); ++s) {
        const MixerSet& set = k_mixer_sets[s];
        std::vector<std::string> row{set_name(s), number(set.restitution), number(set.friction),
                                     number(set.wall_friction), number(set.stiffness)};
        for (const MixerQuantity& quantity : mixer_quantities()) {
            row.push_back(with_spread(over_seeds(sets[s], quantity.of)));
        }
        const double dividing = over_seeds(sets[s], [](const MixerRun& r) { return r.exchange_dividing; }).mean;
        row.push_back(fmt::format("{:.0f}", 100.0 * dividing));
        row.push_back(fmt::format("{:.1f}{}", 100.0 * off[s], s == 0 ? " (seeds)" : ""));
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Sets from most to least, "E > G > A = B"; those less than 2 % apart are held equal.
std::string order_text(const MixerRow& values) {
    constexpr double k_equal = 0.02;
    std::vector<std::size_t> sets;
    for (std::size_t s = 0; s < values.size(); ++s) {
        if (std::isfinite(values[s])) sets.push_back(s);
    }
    std::stable_sort(sets.begin(), sets.end(), [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
    std::string text;
    for (std::size_t k = 0; k < sets.size(); ++k) {
        const bool equal = k > 0 && values[sets[k - 1]] - values[sets[k]] <= k_equal * std::abs(values[sets[k]]);
        text += (k == 0 ? "" : equal ? " ≈ " : " > ") + set_name(sets[k]);
    }
    return text.empty() ? "none" : text;
}

FigureTable table_of_orders(const std::vector<MixerSetRuns>& sets) {
    FigureTable table{
        "Orders, from most to least", {"quantity", "[K02]", "here", "rank correlation", "how [K02] has it"}, {}};
    for (const MixerQuantity& quantity : mixer_quantities()) {
        const MixerRow values = means_of_sets(sets, quantity.of);
        table.rows.push_back({quantity.name, order_text(quantity.order), order_text(values),
                              two_decimals(same_order(quantity.order, values)), quantity.words});
    }
    MixerRow off = speed_differences(sets);
    off.front() = std::nan("");
    table.rows.push_back({"speeds, cell by cell, off the measured ones (here: off those of A)",
                          order_text(mixer_speed_order()), order_text(off),
                          two_decimals(same_order(mixer_speed_order(), off)),
                          "agreement B ≈ A ≈ F > C ≈ D > E > H ≈ G [sec. 4.2]"});
    return table;
}

void write_table(const FigureTable& table, const std::filesystem::path& path) {
    TextFile file(path);
    const auto line = [&](const std::vector<std::string>& fields) {
        std::string text;
        for (const std::string& field : fields) text += (text.empty() ? "" : ",") + csv_field(field);
        file.write(text + "\n");
    };
    line(table.header);
    for (const std::vector<std::string>& row : table.rows) line(row);
    file.close();
}

/// The numbers of the sets, at full length.
FigureTable numbers_of_sets(const std::vector<MixerSetRuns>& sets) {
    FigureTable table{"", {"set", "seed"}, {}};
    for (const MixerQuantity& quantity : mixer_quantities()) table.header.push_back(quantity.column);
    table.header.emplace_back("exchange_dividing_share");
    for (std::size_t s = 0; s < k_mixer_sets.size(); ++s) {
        for (std::size_t seed = 0; seed < sets[s].runs.size(); ++seed) {
            std::vector<std::string> row{set_name(s), fmt::format("{}", seed + 1)};
            for (const MixerQuantity& quantity : mixer_quantities())
                row.push_back(fmt::format("{}", quantity.of(sets[s].runs[seed])));
            row.push_back(fmt::format("{}", sets[s].runs[seed].exchange_dividing));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

}  // namespace

std::vector<Piece> mixer_pieces(const Engines& engines) {
    return at_hand({k_mixer_engine}, engines).empty() ? std::vector<Piece>{} : mixer_pieces();
}

FigureResult draw_mixer(const FigureDesk& desk) {
    FigureResult result;
    if (at_hand({k_mixer_engine}, desk.engines()).empty()) {
        result.paragraphs = {
            "This build has no engine with springs and dashpots, whose parameters are the matter here."};
        return result;
    }
    const std::vector<MixerSetRuns> sets = read_mixer_sets(desk);
    Plot bars{.title = "The eight sets", .columns = 3, .width = 1500, .height = 760};
    for (const MixerQuantity& quantity : mixer_quantities()) bars.panels.push_back(bars_panel(quantity, sets));
    write_plot(bars, desk.stem("kuo-mixer-sets"));
    result.pictures = {
        draw_mixer_sheet(desk, 'A'),
        draw_mixer_sheet(desk, 'G'),
        draw_mixer_sheet(desk, 'E'),
        {desk.stem("kuo-mixer-sets"), "What is measured of the eight sets, mean of the seeds; bars of E are cut off"},
        draw_mixer_rates(desk, sets),
        draw_mixer_velocities(desk, sets),
        draw_mixer_temperatures(desk, sets)};
    result.tables = {table_of_sets(sets), table_of_orders(sets)};
    result.findings = mixer_findings(sets);
    write_table(numbers_of_sets(sets), desk.stem("kuo-mixer-numbers.csv"));
    write_table(result.tables.back(), desk.stem("kuo-mixer-orders.csv"));
    result.paragraphs = {
        fmt::format("The scenario v-mixer with the eight sets of parameters, 60 turns a minute for 8 s, of which the "
                    "first turn is left out; {} seeds each, 476 disks; and at 30 and 45 turns a minute with one seed. "
                    "All is seen from the vessel, in the plane of its "
                    "V: gravity times the sine of the angle turned acts along the V's line of symmetry. Exchange, "
                    "circulation, dispersion and temperature are those of [K02], on its cells of 7.35 mm; the "
                    "temperature is per degree of freedom, half of the sum of [K02, eq. 16] in the plane.",
                    k_mixer_seeds),
        "What two dimensions can show: how grains divide and combine, collisions and friction where they flow, and so "
        "how the parameters change speed, scatter and the exchange through the join. What they cannot: gravity across "
        "the V, which presses grains against the round wall and holds them at rest there until an arm is steep enough; "
        "the avalanche across a tube; and, in this frame, the centrifugal force, which at 60 turns a minute is up to "
        "a third of gravity. Friction can therefore tell here how fast grains slide, "
        "not when they start. The orders of [K02] are read from its text: its plots give no numbers that a scan "
        "keeps."};
    return result;
}

}  // namespace polargrain
