#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "src/record/csv_columns.h"
#include "src/record/summary_reader.h"
#include "src/reproduce/dominoes.h"
#include "src/reproduce/simulation_figures.h"
#include "src/reproduce/statistics.h"
#include "src/theory/domino_theory.h"
#include "src/theory/foot_friction.h"

namespace polargrain {

namespace {

const std::vector<double> k_gaps{1.0, 2.0, 3.0, 4.0, 5.0};
/// About the spacing from which on the paper finds the best agreement.
const std::vector<double> k_narrow{0.75, 1.0, 1.25, 1.5};
const std::vector<double> k_wide{1.75, 2.0, 2.5, 3.0};
/// Of the table, about what struck feet ask of it at a spacing of 1 h where blows are plastic.
const std::vector<double> k_holding{0.88, 0.91};

constexpr const char* k_watched = R"(impacts = true

[[expect]]
quantity = "domino_run_in"
max = 15
source = "[HN94, sec. 4.1]"
)";

Piece watched_row(const DominoKind& kind, double gap, double table_friction = k_rough_table) {
    return domino_piece(DominoSetup{
        .kind = kind, .gap = gap, .table_friction = table_friction, .engine = "contact", .tables = k_watched});
}

/// Opalene whose blows are plastic.
DominoKind plastic() {
    DominoKind kind = table_1().front();
    kind.name += "-plastic";
    kind.restitution = 0.0;
    return kind;
}

/// The blow that topples a domino, and what its foot then asks of the table.
struct FirstBlow {
    double time = 0.0;
    std::optional<double> friction;  ///< impulse along the table over that across it; none where it asks nothing
    bool slides = false;
};

/// By the number of the struck domino.
std::map<int, FirstBlow> first_blows(const std::filesystem::path& run) {
    // The id of a wall is its name, and no number.
    const auto columns = read_columns(run / "impacts.csv").values;
    const auto& i = columns.at("i");
    const auto& j = columns.at("j");
    const auto& step = columns.at("step");
    std::map<int, FirstBlow> blows;
    for (std::size_t row = 0; row < i.size(); ++row) {
        if (std::isnan(i[row]) || std::isnan(j[row])) continue;
        const double struck = std::max(i[row], j[row]);
        const auto [blow, is_first] = blows.try_emplace(static_cast<int>(struck));
        if (!is_first) continue;
        blow->second.time = columns.at("time")[row];
        for (std::size_t next = row + 1; next < i.size() && step[next] == step[row]; ++next) {
            if (i[next] != struck || !std::isnan(j[next])) continue;
            blow->second.friction = std::abs(columns.at("impulse_t")[next]) / columns.at("impulse_n")[next];
            blow->second.slides = std::abs(columns.at("sliding_after")[next]) > 1e-9;
            break;
        }
    }
    return blows;
}

/// What the feet of the second half of a row ask of the table, and how many of them slide.
struct Feet {
    MeanSpread asked;
    double sliding_share = 0.0;
};

Feet read_feet(const std::filesystem::path& run) {
    const auto blows = first_blows(run);
    std::vector<double> asked;
    double sliding = 0.0;
    for (const auto& [domino, blow] : blows) {
        if (2 * domino < static_cast<int>(blows.size()) || !blow.friction) continue;
        asked.push_back(*blow.friction);
        sliding += blow.slides ? 1.0 : 0.0;
    }
    return {mean_and_spread(asked), asked.empty() ? std::nan("") : sliding / static_cast<double>(asked.size())};
}

/// Standard deviation of the speed over single pitches in the second half of a row, over its mean.
double pitch_spread(const std::filesystem::path& run) {
    std::vector<double> speeds;
    const auto blows = first_blows(run);
    for (auto blow = blows.begin(); blow != blows.end() && std::next(blow) != blows.end(); ++blow) {
        // The last one falls with nothing behind it.
        if (2 * blow->first < static_cast<int>(blows.size()) || std::next(blow, 2) == blows.end()) continue;
        speeds.push_back(1.0 / (std::next(blow)->second.time - blow->second.time));
    }
    const MeanSpread m = mean_and_spread(speeds);
    return m.spread / m.mean;
}

void add_run_in(const FigureDesk& desk, FigureResult& result) {
    FigureTable table{"Dominoes that topple before the wave is steady", {"type"}, {}};
    for (const double gap : k_gaps) table.header.push_back(fmt::format("λ = {} h", gap));
    for (const DominoKind& kind : table_1()) {
        table.rows.push_back({kind.name});
        for (const double gap : k_gaps) {
            const double count = read_summary(desk.run(watched_row(kind, gap))).observable("domino_run_in");
            table.rows.back().push_back(fmt::format("{}", count));
            result.findings.push_back(
                {"contact", fmt::format("{}, spacing {} h: dominoes before the wave is steady", kind.name, gap), count,
                 4.0, 15.0, "", "[HN94, sec. 4.1]: 4 to 15, by spacing and first push",
                 "the nearer and the slimmer, the more dominoes lean on one another before the group is complete"});
        }
    }
    result.tables.push_back(std::move(table));
}

void add_pitches(const FigureDesk& desk, FigureResult& result) {
    FigureTable table{"Opalene: standard deviation of the speed from pitch to pitch", {}, {{}}};
    double sum = 0.0;
    for (const double gap : k_gaps) {
        const double spread = pitch_spread(desk.run(watched_row(table_1().front(), gap)));
        table.header.push_back(fmt::format("λ = {} h", gap));
        table.rows.back().push_back(fmt::format("{:.1f} %", 100.0 * spread));
        if (gap > 1.5 && gap < 4.5) sum += spread;
    }
    result.tables.push_back(std::move(table));
    result.findings.push_back({"contact", "Opalene, spacings 2 to 4 h: spread of the speed from pitch to pitch",
                               100.0 * sum / 3.0, 4.0, 12.0, "%",
                               "pinned-foot chain with e = 0.85: 4 to 12 %, so that 20 pitches must be averaged", ""});
}

void add_feet(const FigureDesk& desk, FigureResult& result) {
    const DominoKind& opalene = table_1().front();
    const auto asked_of = [](const DominoKind& kind, double gap, StrikerFoot striker) {
        return foot_friction(kind.row(gap), striker);
    };
    const double pinned = asked_of(plastic(), 1.0, StrikerFoot::held);
    result.findings.push_back({"contact", "plastic blows, spacing 1 h: friction that struck feet ask of the table",
                               read_feet(desk.run(watched_row(plastic(), 1.0))).asked.mean, 0.99 * pinned,
                               1.01 * pinned, "", fmt::format("closed form with pinned feet: {:.3f}", pinned), ""});
    for (const double friction : k_holding) {
        const double share = read_feet(desk.run(watched_row(plastic(), 1.0, friction))).sliding_share;
        const double expected = friction < pinned ? 1.0 : 0.0;
        result.findings.push_back(
            {"contact", fmt::format("the same on a table with μ = {}: share of feet that slide", friction), share,
             expected, expected, "", fmt::format("they slide below {:.3f} and hold above", pinned), ""});
    }
    FigureTable table{"Opalene: friction that struck feet ask of the table",
                      {"spacing", "contact", "closed form, striker let go", "closed form, striker pinned"},
                      {}};
    for (const double gap : k_gaps) {
        const Feet feet = read_feet(desk.run(watched_row(opalene, gap)));
        const double let_go = asked_of(opalene, gap, StrikerFoot::free);
        table.rows.push_back(
            {fmt::format("{} h", gap), fmt::format("{:.3f} ± {:.3f}", feet.asked.mean, feet.asked.spread),
             fmt::format("{:.3f}", let_go), fmt::format("{:.3f}", asked_of(opalene, gap, StrikerFoot::held))});
        if (gap > 3.5) continue;  // struck near the centre of percussion, where it asks next to nothing
        result.findings.push_back(
            {"contact", fmt::format("Opalene, spacing {} h: friction that struck feet ask of the table", gap),
             feet.asked.mean, 0.98 * let_go, 1.02 * let_go, "",
             fmt::format("closed form, the striker's foot let go: {:.3f}", let_go), ""});
    }
    result.tables.push_back(std::move(table));
}

Piece literal_row(const DominoKind& kind, double gap) { return domino_piece(kind, gap, k_rough_table, "contact-1994"); }

/// Mean difference of the speed from the group theory, relative; a row without a wave counts as wholly off.
double difference_from_theory(const FigureDesk& desk, const std::vector<DominoKind>& kinds,
                              const std::vector<double>& gaps) {
    double sum = 0.0;
    for (const DominoKind& kind : kinds) {
        for (const double gap : gaps) {
            const double speed = read_summary(desk.run(literal_row(kind, gap))).observable("domino_speed");
            sum += std::isfinite(speed) ? std::abs(speed / group_theory_speed(kind.row(gap)) - 1.0) : 1.0;
        }
    }
    return sum / static_cast<double>(kinds.size() * gaps.size());
}

void add_spacing(const FigureDesk& desk, FigureResult& result) {
    FigureTable table{"contact-1994: mean difference of the speed from the group theory",
                      {"type", "λ / h from 0.75 to 1.5", "λ / h from 1.75 to 3"},
                      {}};
    const auto add_row = [&](const std::string& name, const std::vector<DominoKind>& kinds) {
        const double narrow = difference_from_theory(desk, kinds, k_narrow);
        const double wide = difference_from_theory(desk, kinds, k_wide);
        table.rows.push_back({name, fmt::format("{:.1f} %", 100.0 * narrow), fmt::format("{:.1f} %", 100.0 * wide)});
        return wide / narrow;
    };
    for (const DominoKind& kind : table_1()) add_row(kind.name, {kind});
    result.findings.push_back({"contact-1994",
                               "difference from the group theory above a spacing of 1.5 h over that below",
                               add_row("all", table_1()), 0.0, 0.95, "",
                               "[HN94, sec. 4.1]: agreement is best above 1.5 h; the experiments are not printed", ""});
    result.tables.push_back(std::move(table));
}

}  // namespace

std::vector<Piece> domino_wave_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    if (!at_hand({"contact"}, engines).empty()) {
        for (const DominoKind& kind : table_1()) {
            for (const double gap : k_gaps) pieces.push_back(watched_row(kind, gap));
        }
        pieces.push_back(watched_row(plastic(), 1.0));
        for (const double friction : k_holding) pieces.push_back(watched_row(plastic(), 1.0, friction));
    }
    if (!at_hand({"contact-1994"}, engines).empty()) {
        for (const DominoKind& kind : table_1()) {
            for (const double gap : k_narrow) pieces.push_back(literal_row(kind, gap));
            for (const double gap : k_wide) pieces.push_back(literal_row(kind, gap));
        }
    }
    return pieces;
}

FigureResult draw_domino_wave(const FigureDesk& desk) {
    FigureResult result;
    if (!at_hand({"contact"}, desk.engines()).empty()) {
        add_run_in(desk, result);
        add_pitches(desk, result);
        add_feet(desk, result);
    }
    if (!at_hand({"contact-1994"}, desk.engines()).empty()) add_spacing(desk, result);
    result.paragraphs = {
        "What the paper says of the wave in words, on rows of 48 dominoes on a table with μ = 1.5. The wave is steady "
        "from the domino on at which, and at all later ones, the mean speed over five pitches is within 5 % of that "
        "over the second half of the row.",
        "A struck domino turns about the front of its foot, which slides unless the table is rough enough. A floor "
        "does not pull: where blows are not plastic, the striking domino's foot is let go, its corner slides back up "
        "before the blow is over, and pushes the struck one down less than a pinned one would."};
    return result;
}

}  // namespace polargrain
