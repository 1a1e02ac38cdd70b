#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/reader.h"
#include "shapes/outline.h"
#include "src/detect/contact_finder.h"
#include "src/detect/overlap.h"
#include "src/engines/contact/contact_1994.h"
#include "src/engines/contact/motion_update.h"
#include "src/reproduce/shape_figures.h"
#include "src/reproduce/sketch.h"

namespace polargrain {

namespace {

/// One of the four drawings: j, on which i falls, and the normal found by hand.
struct NormalDrawing {
    std::string title;
    std::vector<Vec2> i, j;
    Vec2 expected;
    NormalCase which;
};

std::vector<NormalDrawing> four_drawings() {
    return {{"(a) one vertex through a flat face",
             {{0.3, -0.25}, {1.0, 1.0}, {-0.6, 1.1}},
             {{-2.0, -1.4}, {2.0, -1.4}, {2.0, 0.0}, {-2.0, 0.0}},
             {0.0, 1.0},
             NormalCase::flat},
            {"(b) one vertex over a corner",
             {{0.05, -0.3}, {0.5, 1.0}, {0.0, 1.6}, {-0.5, 0.9}},
             {{0.0, 0.0}, {-2.0, -0.3}, {-1.0, -2.0}, {1.0, -2.0}, {2.0, -0.4}},
             {0.1, 4.0},
             NormalCase::corner},
            {"(c) several vertices of i inside j",
             {{-0.30, -0.3}, {0.0, -0.05}, {0.20, -0.2}, {1.5, 0.9}, {0.0, 1.6}, {-1.5, 0.9}},
             {{0.0, 0.0}, {-2.0, -0.5}, {-1.0, -2.2}, {1.0, -2.2}, {2.0, -0.5}},
             {0.0, 1.0},
             NormalCase::multi_owner},
            {"(d) several vertices of j inside i",
             {{0.0, -0.3}, {2.0, -0.35}, {1.8, 1.8}, {-1.8, 1.8}, {-2.0, 0.0}},
             {{0.4, 0.0}, {-0.4, 0.05}, {-1.5, -1.5}, {1.5, -1.5}},
             {0.05, 0.8},
             NormalCase::multi_other}};
}

double degrees_between(const Vec2& a, const Vec2& b) {
    return std::abs(std::atan2(cross(a, b), a.dot(b))) / k_radians_per_degree;
}

constexpr double k_step = 1e-3;  // of Fig. 9 [s]
const std::vector<std::string> k_names{"A", "B", "C", "D"};

/// Steps 1 to 5 of the motion update, with the plain closure besides.
struct UpdateExample {
    Scene scene;
    std::vector<Pose> current, trial;
    TrialOverlaps found;
    std::vector<char> rejected;
};

UpdateExample update_example() {
    UpdateExample example{load_scenario(find_scenario("fig9")).scene, {}, {}, {}, {}};
    const Grains& grains = example.scene.grains;
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const double spin = grains.spin[Grains::at(k)];
        example.current.push_back(grains.pose(k));
        example.trial.push_back(
            Pose::at(grains.position(k) + k_step * grains.velocity(k), grains.angle[Grains::at(k)] + k_step * spin));
    }
    const auto meet = [&](GrainIndex a, const std::vector<Pose>& of_a, GrainIndex b, const std::vector<Pose>& of_b) {
        return overlap(example.scene.shape_of(a), of_a[Grains::at(a)], example.scene.shape_of(b), of_b[Grains::at(b)]);
    };
    example.found.blocked.assign(k_names.size(), 0);
    for (GrainIndex a = 0; a < grains.size(); ++a) {
        for (GrainIndex b = 0; b < grains.size(); ++b) {
            if (a < b && meet(a, example.trial, b, example.trial)) example.found.conflicts.emplace_back(a, b);
            if (a != b && meet(a, example.current, b, example.trial)) example.found.order.emplace_back(a, b);
        }
    }
    MotionUpdate update;
    example.rejected = update.decide(example.found);
    return example;
}

/// current and trial: 0 not drawn, 1 outline, 2 filled.
Panel update_panel(const UpdateExample& example, const std::string& title, SeriesStyle current, SeriesStyle trial,
                   bool updated) {
    Panel panel{.title = title, .map = true};
    for (std::size_t k = 0; k < k_names.size(); ++k) {
        const Shape& shape = example.scene.shape_of(static_cast<GrainIndex>(k));
        const int colour = static_cast<int>(k);
        const bool moves = updated && !example.rejected[k];
        if (!updated) panel.series.push_back(sketch_shape(shape, example.trial[k], trial, colour));
        panel.series.push_back(sketch_shape(shape, moves ? example.trial[k] : example.current[k], current, colour));
        const Pose& named = moves ? example.trial[k] : example.current[k];
        panel.series.push_back(sketch_text(named.centre, k_names[k] + (moves ? "'" : "")));
    }
    panel.x_range = {-0.012, 0.078};
    panel.y_range = {-0.013, 0.013};
    return panel;
}

std::string pairs_text(const std::vector<std::pair<GrainIndex, GrainIndex>>& pairs, const char* between,
                       const char* after) {
    std::string text;
    for (const auto& [a, b] : pairs) {
        text += (text.empty() ? "" : ", ") + k_names[Grains::at(a)] + between + k_names[Grains::at(b)] + after;
    }
    return text;
}

/// How far the engine's own step differs from the example's decision [m].
double engine_differs(const UpdateExample& example) {
    const std::unique_ptr<Engine> engine = make_contact_1994(example.scene);
    World world = initial_world(example.scene);
    StepReport report;
    engine->step(world, k_step, report);
    double most = 0.0;
    for (std::size_t k = 0; k < k_names.size(); ++k) {
        const Pose& pose = example.rejected[k] ? example.current[k] : example.trial[k];
        const Vec2 off = world.grains.position(static_cast<GrainIndex>(k)) - pose.centre;
        most = std::max(most, std::sqrt(off.squaredNorm()));
    }
    return most;
}

}  // namespace

FigureResult draw_fig7(const FigureDesk& desk) {
    FigureResult result;
    Plot plot{.title = "Fig. 7: normal direction of impact, as the program finds it",
              .columns = 2,
              .width = 1300,
              .height = 1000};
    FigureTable table{"The four cases", {"case", "rule that was used", "normal out of j into i", "contact vertex"}, {}};
    for (const NormalDrawing& drawing : four_drawings()) {
        const MassProperties mass_i = mass_properties("i", drawing.i), mass_j = mass_properties("j", drawing.j);
        const Shape i = prepare_outline("i", drawing.i), j = prepare_outline("j", drawing.j);
        const Pose pose_i = Pose::at(mass_i.centroid, 0.0), pose_j = Pose::at(mass_j.centroid, 0.0);
        const auto contact = find_contact({i, pose_i, {{0.0, -1.0}, 0.0}}, {j, pose_j, {}});
        const Vec2 normal = contact ? contact->normal : Vec2(Vec2::Zero());
        const Vec2 point = contact ? contact->point : Vec2(Vec2::Zero());
        const bool right_case = contact && contact->which == drawing.which;
        Panel panel{.title = drawing.title, .map = true};
        const Vec2 across = 1.6 * left_normal(normal);
        panel.series = {sketch_shape(j, pose_j, SeriesStyle::filled, 0),
                        sketch_shape(i, pose_i, SeriesStyle::filled, 1),
                        Series{.style = SeriesStyle::dashed,
                               .x = {(point - across).x(), (point + across).x()},
                               .y = {(point - across).y(), (point + across).y()},
                               .colour = 6,
                               .width = 1.0},
                        sketch_arrow(point, 1.3 * normal, 3),
                        sketch_point(point, 6),
                        sketch_text(pose_i.centre + Vec2(-0.45, 0.15), "i"),
                        sketch_text(pose_j.centre, "j")};
        plot.panels.push_back(std::move(panel));
        table.rows.push_back({drawing.title, contact ? to_string(contact->which) : "no contact",
                              fmt::format("({:.4f}, {:.4f})", normal.x(), normal.y()),
                              fmt::format("({:.2f}, {:.2f})", point.x(), point.y())});
        result.findings.push_back(
            {"", drawing.title + ": rule is the figure's", right_case ? 1.0 : 0.0, 1.0, 1.0, "", "[HN94, Fig. 7]", ""});
        result.findings.push_back({"", drawing.title + ": angle to the normal found by hand",
                                   degrees_between(normal, drawing.expected), 0.0, 1e-9, "degrees",
                                   "construction by hand", ""});
    }
    write_plot(plot, desk.stem("fig7"));
    result.paragraphs = {
        "Four pairs of outlines, given to the contact finder that both contact engines share; i falls on j. The arrow "
        "is the "
        "normal that came out, the dashed line the common tangent, the dot the contact vertex."};
    result.pictures = {{desk.stem("fig7"), "Contact vertex and normal of the four cases"}};
    result.tables = {std::move(table)};
    return result;
}

FigureResult draw_fig9(const FigureDesk& desk) {
    const UpdateExample example = update_example();
    using enum SeriesStyle;
    Plot plot{.title = "Fig. 9: who may move", .columns = 2, .width = 1300, .height = 560};
    plot.panels = {
        update_panel(example, "(a) where they are, and where they want to be", filled, outline, false),
        update_panel(example, "(b) trial places: B' and C' meet", outline, filled, false),
        update_panel(example, "(c) trial places over present ones: who waits for whom", filled, filled, false),
        update_panel(example, "(d) after the step: C has stayed", filled, outline, true)};
    write_plot(plot, desk.stem("fig9"));

    const WarshallClosure closure(static_cast<GrainIndex>(k_names.size()), example.found.order);
    FigureTable matrix{"Transitive closure: 1 where the grain of the column must stay if that of the row stays",
                       {"", "A", "B", "C", "D", "dependants"},
                       {}};
    MotionUpdate update;
    update.decide(example.found);
    FigureResult result;
    const std::vector<double> published{1.0, 3.0, 0.0, 0.0};
    for (std::size_t a = 0; a < k_names.size(); ++a) {
        const auto row = static_cast<GrainIndex>(a);
        std::vector<std::string> cells{k_names[a]};
        for (std::size_t b = 0; b < k_names.size(); ++b) {
            cells.emplace_back(closure.related(row, static_cast<GrainIndex>(b)) ? "1" : "0");
        }
        const int dependants = closure.dependants(row);
        cells.push_back(fmt::format("{}", dependants));
        matrix.rows.push_back(std::move(cells));
        result.findings.push_back({"", "grains that depend on " + k_names[a], static_cast<double>(dependants),
                                   published[a], published[a], "", "[HN94, eq. 55]", ""});
        result.findings.push_back({"", "the same by the engine's breadth-first search, " + k_names[a],
                                   static_cast<double>(update.dependants(row)), static_cast<double>(dependants),
                                   static_cast<double>(dependants), "", "Warshall's algorithm", ""});
    }
    const auto rejected = std::count(example.rejected.begin(), example.rejected.end(), 1);
    result.findings.push_back({"", "trial contacts", static_cast<double>(example.found.conflicts.size()), 1.0, 1.0, "",
                               "[HN94, Fig. 9b]: B'-C' alone", ""});
    result.findings.push_back(
        {"", "grains that stay", static_cast<double>(rejected), 1.0, 1.0, "", "[HN94, Fig. 9d]", ""});
    result.findings.push_back({"", "C stays", example.rejected[2] ? 1.0 : 0.0, 1.0, 1.0, "", "[HN94, Fig. 9d]", ""});
    result.findings.push_back({"contact-1994", "distance between the engine's own step and this",
                               engine_differs(example), 0.0, 1e-15, "m", "the same decision", ""});
    result.paragraphs = {
        fmt::format("The four grains of the scenario fig9, one step of 1 ms. Trial contacts: {}. Who must move before "
                    "whom: {}. The "
                    "closure below is Warshall's; C, on which fewest hang, stays.",
                    pairs_text(example.found.conflicts, "'-", "'"), pairs_text(example.found.order, " before ", ""))};
    result.pictures = {{desk.stem("fig9"), "The four panels of the figure, from the real overlap test and closure"}};
    result.tables = {std::move(matrix)};
    return result;
}

}  // namespace polargrain
