#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/plot/plot.h"
#include "src/record/summary_reader.h"
#include "src/record/trajectory_reader.h"
#include "src/reproduce/dominoes.h"
#include "src/reproduce/simulation_figures.h"
#include "src/theory/domino_chain.h"
#include "src/theory/domino_theory.h"

namespace polargrain {

namespace {

const std::vector<double> k_gaps{1.0, 2.0, 3.0, 4.0, 5.0};
const std::vector<double> k_table_frictions{0.3, 0.5, 1.5};
/// Dominoes, and speeds at spacings of 1 to 5 thicknesses, as computed by independent programs to three decimals.
struct KnownSpeeds {
    std::string name;
    DominoRow (*row)(double gap);
    std::vector<double> speeds;
};
DominoRow row_of_curve(double gap) { return {0.12, 0.12 * gap, 0.0, 0.2}; }
const std::vector<KnownSpeeds> k_group_speeds{
    {"Opalene", [](double gap) { return table_1()[0].row(gap); }, {1.491, 1.375, 1.283, 1.177, 0.977}},
    {"Perspex", [](double gap) { return table_1()[1].row(gap); }, {1.498, 1.391, 1.327, 1.270, 1.206}},
    {"Tufnol", [](double gap) { return table_1()[2].row(gap); }, {1.721, 1.567, 1.488, 1.425, 1.361}},
    {"the paper's curve", row_of_curve, {1.608, 1.479, 1.408, 1.349, 1.286}}};
const std::vector<double> k_chain_speeds{1.568, 1.453, 1.436, 1.403, 1.197};

constexpr const char* k_x_label = "spacing λ / h";
constexpr const char* k_y_label = "natural speed V / √(g L)";

/// Speed over spacing, from a function of the row.
template <typename Theory>
Series curve(const std::string& label, SeriesStyle style, int colour, Theory speed, double gap_step = 0.25) {
    Series series{.label = label, .style = style, .colour = colour};
    for (double gap = 1.0; gap <= 5.0 + 1e-9; gap += gap_step) {
        series.x.push_back(gap);
        series.y.push_back(speed(gap));
    }
    return series;
}

Series measured(const FigureDesk& desk, const DominoKind& kind, double table_friction, const std::string& engine,
                const std::string& label, int colour) {
    Series series{.label = label, .style = SeriesStyle::points, .colour = colour};
    for (const double gap : k_gaps) {
        series.x.push_back(gap);
        series.y.push_back(
            read_summary(desk.run(domino_piece(kind, gap, table_friction, engine))).observable("domino_speed"));
    }
    return series;
}

/// The lower and the upper of the theories that bracket a rough floor: the group, whose collisions are plastic, and the
/// chain, whose impacts keep all the restitution of Table 1.
Finding held_to_theories(const std::string& engine, const DominoKind& kind, double gap, double speed, double chain) {
    const double group = group_theory_speed(kind.row(gap));
    Finding finding{
        engine,
        fmt::format("{}, spacing {} h: V / √(g L)", kind.name, gap),
        speed,
        0.97 * std::min(group, chain),
        1.03 * std::max(group, chain),
        "",
        fmt::format("between group theory ({:.3f}) and pinned-foot chain ({:.3f}), 3 % besides", group, chain),
        ""};
    if (engine == "contact-1994") {
        finding.why =
            "rejected moves: many collisions between neighbours in each step leave dominoes where they are, as the "
            "paper "
            "says of spacings below 1.5 h";
    }
    return finding;
}

Panel material_panel(const FigureDesk& desk, const DominoKind& kind, std::vector<Finding>& findings) {
    Panel panel{.title = fmt::format("{}: h / L {:.3f}, e {}, μ {}", kind.name, kind.thickness / kind.height,
                                     kind.restitution, kind.friction),
                .x_label = k_x_label,
                .y_label = k_y_label,
                .x_range = std::pair{0.8, 5.2},
                .y_range = std::pair{0.0, 2.8},
                .key = KeyPlace::top_right};
    const Series chain = curve(
        "pinned-foot chain, Table 1's e and μ", SeriesStyle::line, 2,
        [&](double gap) { return pinned_chain_speed(kind.row(gap), 70, k_chain_step); }, 0.5);
    panel.series.push_back(curve("group theory with friction", SeriesStyle::line, 6,
                                 [&](double gap) { return group_theory_speed(kind.row(gap)); }));
    panel.series.push_back(chain);
    panel.series.push_back(curve("single-collision theory", SeriesStyle::dashed, 5,
                                 [&](double gap) { return single_collision_speed(kind.row(gap)); }));
    int colour = 0;
    for (const std::string& engine : at_hand(domino_engines(), desk.engines())) {
        const Series points = measured(desk, kind, k_rough_table, engine, engine, colour++);
        for (std::size_t k = 0; k < points.x.size(); ++k) {
            const auto same_gap = std::find(chain.x.begin(), chain.x.end(), points.x[k]) - chain.x.begin();
            findings.push_back(
                held_to_theories(engine, kind, points.x[k], points.y[k], chain.y[static_cast<std::size_t>(same_gap)]));
        }
        panel.series.push_back(points);
    }
    return panel;
}

Panel floor_panel(const FigureDesk& desk) {
    const DominoKind& kind = table_1().front();
    Panel panel{.title = "Opalene on tables of different friction",
                .x_label = k_x_label,
                .y_label = k_y_label,
                .x_range = std::pair{0.8, 5.2},
                .y_range = std::pair{0.0, 2.8},
                .key = KeyPlace::top_right};
    int colour = 0;
    for (const std::string& engine : at_hand(domino_engines(), desk.engines())) {
        for (const double friction : k_table_frictions) {
            panel.series.push_back(
                measured(desk, kind, friction, engine, fmt::format("{}, table μ {}", engine, friction), colour++));
        }
    }
    panel.series.push_back(curve("the paper's curve: group theory, h / L 0.12, μ 0.2", SeriesStyle::line, 6,
                                 [](double gap) { return group_theory_speed(row_of_curve(gap)); }));
    return panel;
}

FigureTable floor_table(const FigureDesk& desk) {
    FigureTable table{"V / √(g L) of Opalene over the friction of the table", {"engine", "table μ"}, {}};
    for (const double gap : k_gaps) table.header.push_back(fmt::format("λ = {} h", gap));
    for (const std::string& engine : at_hand(domino_engines(), desk.engines())) {
        for (const double friction : k_table_frictions) {
            const Series s = measured(desk, table_1().front(), friction, engine, "", 0);
            std::vector<std::string> row{engine, fmt::format("{}", friction)};
            for (const double v : s.y) row.push_back(std::isfinite(v) ? fmt::format("{:.3f}", v) : "no wave");
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

}  // namespace

std::vector<Piece> fig11_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    for (const std::string& engine : at_hand(domino_engines(), engines)) {
        for (const DominoKind& kind : table_1()) {
            for (const double gap : k_gaps) pieces.push_back(domino_piece(kind, gap, k_rough_table, engine));
        }
        for (const double friction : k_table_frictions) {
            for (const double gap : k_gaps) pieces.push_back(domino_piece(table_1().front(), gap, friction, engine));
        }
    }
    return pieces;
}

FigureResult draw_fig11(const FigureDesk& desk) {
    FigureResult result;
    Plot plot{.title = "Fig. 11: natural speed of toppling dominoes", .columns = 2, .width = 1500, .height = 1150};
    for (const DominoKind& kind : table_1()) plot.panels.push_back(material_panel(desk, kind, result.findings));
    plot.panels.push_back(floor_panel(desk));
    write_plot(plot, desk.stem("fig11"));
    result.paragraphs = {
        "Rows of 48 dominoes of Table 1, spaced 1 to 5 thicknesses; the speed is that over the second half of the row, "
        "23 "
        "pitches. The theories take the feet as pinned: the table has μ = 1.5 in the first three panels. The fourth "
        "shows "
        "what an ordinary table does: struck feet slide, and the chain no longer holds.",
        "The experiments of Stronge and Shu that the paper plots are not printed as numbers; the paper's statement is "
        "that "
        "simulation, experiment and group theory agree, best above a spacing of 1.5 h."};
    result.pictures = {{desk.stem("fig11"), "Speed over spacing: engines, and three theories computed by the program"}};
    result.tables = {floor_table(desk)};
    return result;
}

namespace {

/// The theories themselves, as computed here.
void add_theories(std::vector<Finding>& findings) {
    const auto add = [&](const std::string& what, double gap, double speed, double known, double margin) {
        findings.push_back({"", fmt::format("{}, spacing {} h: V / √(g L)", what, gap), speed, known - margin,
                            known + margin, "", fmt::format("{:.3f} by an independent program", known), ""});
    };
    for (const KnownSpeeds& known : k_group_speeds) {
        for (std::size_t k = 0; k < k_gaps.size(); ++k) {
            add(known.name + ", group theory with friction", k_gaps[k], group_theory_speed(known.row(k_gaps[k])),
                known.speeds[k], 5.5e-4);
        }
    }
    for (std::size_t k = 0; k < k_gaps.size(); ++k) {
        const double speed = pinned_chain_speed(table_1().front().row(k_gaps[k]), 70, k_chain_step);
        add("Opalene, pinned-foot chain", k_gaps[k], speed, k_chain_speeds[k], 0.01 * k_chain_speeds[k]);
    }
    const double group = group_theory_speed(row_of_curve(2.0));
    findings.push_back({"", "the paper's curve, spacing 2 h: chain with plastic blows over group theory",
                        pinned_chain_speed(row_of_curve(2.0), 70, k_chain_step) / group, 0.9975, 1.0025, "",
                        "the two meet to 0.25 %", ""});
}

}  // namespace

std::vector<Piece> table1_pieces(const Engines& engines) {
    std::vector<Piece> pieces;
    const Engines chosen = at_hand({"contact"}, engines);
    for (const DominoKind& kind : table_1()) {
        for (const std::string& engine : chosen) pieces.push_back(domino_piece(kind, 2.0, k_rough_table, engine, 0.05));
    }
    return pieces;
}

FigureResult draw_table1(const FigureDesk& desk) {
    FigureResult result;
    FigureTable table{
        "Dominoes, as the stored runs carry them",
        {"type", "L [mm]", "h [mm]", "h / L", "e", "μ", "mass [kg/m]", "inertia [kg m]", "falls beyond [°]"},
        {}};
    Panel panel{
        .title = "group theory with friction, from Table 1's values", .x_label = k_x_label, .y_label = k_y_label};
    int colour = 0;
    for (const DominoKind& kind : table_1()) {
        const Piece piece = domino_piece(kind, 2.0, k_rough_table, "contact", 0.05);
        const TrajectoryReader recording(desk.run(piece) / "trajectory.h5");
        const Scene& scene = recording.scene();
        const auto& outline = std::get<PolarPolygon>(scene.shape_of(1));
        double width = 0.0, height = 0.0;
        for (const Vec2& v : outline.vertices()) {
            width = std::max(width, 2.0 * std::abs(v.x()));
            height = std::max(height, 2.0 * std::abs(v.y()));
        }
        const Material& material = scene.materials[scene.grains.material[1]];
        const double mass = scene.grains.mass[1], inertia = scene.grains.inertia[1];
        const auto near = [&](const std::string& quantity, double value, double expected, const std::string& against) {
            result.findings.push_back({"", kind.name + ": " + quantity, value, expected * (1.0 - 1e-12),
                                       expected * (1.0 + 1e-12), "", against, ""});
        };
        near("L [mm]", 1e3 * height, 1e3 * kind.height, "[HN94, Table 1]");
        near("h [mm]", 1e3 * width, 1e3 * kind.thickness, "[HN94, Table 1]");
        near("e", material.restitution.mean, kind.restitution, "[HN94, Table 1]");
        near("μ", material.friction, kind.friction, "[HN94, Table 1]");
        near("inertia over m (L² + h²) / 12", inertia / (mass * (width * width + height * height) / 12.0), 1.0,
             "closed form");
        table.rows.push_back({kind.name, fmt::format("{:.1f}", 1e3 * height), fmt::format("{:.1f}", 1e3 * width),
                              fmt::format("{:.4f}", width / height), fmt::format("{}", material.restitution.mean),
                              fmt::format("{}", material.friction), fmt::format("{:.5f}", mass),
                              fmt::format("{:.4e}", inertia),
                              fmt::format("{:.2f}", std::atan(width / height) * 180.0 / M_PI)});
        panel.series.push_back(curve(kind.name, SeriesStyle::line, colour++,
                                     [&](double gap) { return group_theory_speed(kind.row(gap)); }));
    }
    add_theories(result.findings);
    write_plot({"Table 1: what its values lead to", {panel}, 1, 900, 560}, desk.stem("table1"));
    result.paragraphs = {
        "The values of Table 1, read back from the recordings of the runs that use them, with what follows from them. "
        "The "
        "dominoes have 24 vertices along their sides."};
    result.tables = {std::move(table)};
    result.pictures = {{desk.stem("table1"), "Speed that theory gives for the three kinds"}};
    return result;
}

}  // namespace polargrain
