#include "src/reproduce/dominoes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain {

namespace {

constexpr double k_g = 9.81;

constexpr const char* k_template = R"(title = "Toppling dominoes, {name}, gap {gap} thicknesses"
source = "Hogue & Newland 1994, section 4.1, Table 1, Figures 10-12"

[run]
engine = "{engine}"
duration = {duration}
gravity = {g}
time_step_factor = {factor}

[materials.domino]
density = 1190.0
restitution = {e}
friction = {mu}

[materials.table]
restitution = {e}
friction = {table_mu}

[[pairs]]
between = ["domino", "table"]
restitution = {e}
friction = {table_mu}

[shapes.domino]
type = "rectangle"
width = {h}
height = {L}
vertices = 24

[[walls]]
name = "table"
material = "table"
points = [[{left}, 0.0], [{right}, 0.0]]

[[rows]]
shape = "domino"
material = "domino"
count = {count}
start = [0.0, {half}]
step = [{pitch}, 0.0]
first = {{ position = [0.0, {raised}], angle = {lean}, velocity = [{push}, 0.0], spin = {spin} }}

[output]
frames = {{ every = 0.0 }}
trajectory = {{ every = {recorded} }}
series = {{ every = 0.0 }}
{tables})";

}  // namespace

DominoRow DominoKind::row(double gap) const {
    return {thickness / height, gap * thickness / height, restitution, friction};
}

double DominoKind::speed_unit() const { return std::sqrt(k_g * height); }

const std::vector<DominoKind>& table_1() {
    static const std::vector<DominoKind> kinds{{"Opalene", 41.8e-3, 7.5e-3, 0.85, 0.18},
                                               {"Perspex", 80.0e-3, 9.9e-3, 0.55, 0.25},
                                               {"Tufnol", 80.0e-3, 9.6e-3, 0.65, 0.15}};
    return kinds;
}

const std::vector<std::string>& domino_engines() {
    static const std::vector<std::string> engines{"contact", "contact-1994"};
    return engines;
}

Piece domino_piece(const DominoSetup& setup) {
    using namespace fmt::literals;
    const DominoKind& kind = setup.kind;
    const double pitch = kind.thickness * (1.0 + setup.gap);
    // Half the way to the next one, so that the first does not stand in it.
    const double lean = setup.lean * std::min(0.14, 0.5 * std::asin(setup.gap * kind.thickness / kind.height));
    const double raised = 0.5 * (kind.height * std::cos(lean) + kind.thickness * std::sin(lean)) + kind.height / 400.0;
    // A push that topples the next one at every spacing: the rate at which the chain of the theories is set going.
    const double rate = std::sqrt(k_g / kind.height);
    // The slowest wave of all theories takes this long, and half as long again.
    const double duration = 1.5 * pitch * setup.count / (0.9 * kind.speed_unit()) + 0.3;
    std::string name =
        fmt::format("dominoes-{}-gap{}-mu{}-{}", kind.name, setup.gap, setup.table_friction, setup.engine);
    std::transform(name.begin(), name.end(), name.begin(), [](char c) { return c == '.' ? 'p' : c; });
    if (setup.recorded > 0.0) name += "-recorded";
    // The literal method freezes lasting contacts for a step at a time and needs a fraction of its own limit here; the
    // refined one gets the same step. The others choose their own.
    const double factor = setup.time_step_factor.value_or(setup.engine.starts_with("contact") ? 0.14 : 1.0);
    return {name,
            fmt::format(fmt::runtime(k_template), "name"_a = kind.name, "gap"_a = setup.gap, "engine"_a = setup.engine,
                        "duration"_a = duration, "g"_a = k_g, "e"_a = kind.restitution, "mu"_a = kind.friction,
                        "table_mu"_a = setup.table_friction, "h"_a = kind.thickness, "L"_a = kind.height,
                        "left"_a = -5.0 * kind.height, "right"_a = pitch * setup.count + 5.0 * kind.height,
                        "count"_a = setup.count, "half"_a = 0.5 * kind.height, "pitch"_a = pitch, "raised"_a = raised,
                        "lean"_a = -lean * 180.0 / M_PI, "spin"_a = -rate, "push"_a = 0.5 * rate * kind.height,
                        "recorded"_a = setup.recorded, "factor"_a = factor, "tables"_a = setup.tables),
            setup.engine};
}

Piece domino_piece(const DominoKind& kind, double gap, double table_friction, const std::string& engine,
                   double recorded) {
    return domino_piece(DominoSetup{
        .kind = kind, .gap = gap, .table_friction = table_friction, .engine = engine, .recorded = recorded});
}

}  // namespace polargrain
