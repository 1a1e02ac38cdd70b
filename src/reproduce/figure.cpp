#include "src/reproduce/figure.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "src/core/error.h"
#include "src/core/nearest_name.h"
#include "src/reproduce/shape_figures.h"
#include "src/reproduce/simulation_figures.h"

namespace polargrain {

namespace {

std::vector<Piece> no_pieces(const std::vector<std::string>& /*engines*/) { return {}; }

}  // namespace

std::span<const Figure> figures() {
    static const std::array<Figure, 14> table{{
        {"fig2", "Figure 2: a particle in polar form", no_pieces, draw_fig2},
        {"fig5", "Figure 5: is a vertex inside a grain?", no_pieces, draw_fig5},
        {"fig7", "Figure 7: normal direction of impact", no_pieces, draw_fig7},
        {"fig9", "Figure 9: the motion update, step by step", no_pieces, draw_fig9},
        {"table1", "Table 1: the dominoes", table1_pieces, draw_table1},
        {"fig11", "Figure 11: speed of toppling dominoes", fig11_pieces, draw_fig11},
        {"fig12", "Figure 12: snapshots of toppling dominoes", fig12_pieces, draw_fig12},
        {"domino-wave", "Section 4.1: when the wave is steady, and whether feet slide", domino_wave_pieces,
         draw_domino_wave},
        {"fig14", "Figure 14: pouring 500 disks, snapshots", pouring_pieces, draw_fig14},
        {"fig15", "Figure 15: pouring 500 disks, potential energy and area fraction", pouring_pieces, draw_fig15},
        {"fig16", "Figure 16: rough grains out of a square bin", fig16_pieces, draw_fig16},
        {"fig17", "Figure 17: sticks out of a square bin", fig17_pieces, draw_fig17},
        {"efficiency", "Section 4.4: efficiency", efficiency_pieces, draw_efficiency},
        {"kuo-mixer", "Kuo et al. 2002: a V-mixer under eight sets of parameters", mixer_pieces, draw_mixer},
    }};
    return table;
}

std::vector<Figure> find_figures(const std::vector<std::string>& ids) {
    const std::span<const Figure> all = figures();
    std::vector<std::string> names;
    for (const Figure& figure : all) names.push_back(figure.id);
    for (const std::string& id : ids) {
        if (std::find(names.begin(), names.end(), id) != names.end()) continue;
        const std::string nearest = nearest_name(id, names);
        throw InputError(fmt::format("{}: there is no such figure{}; there are {}", id,
                                     nearest.empty() ? "" : fmt::format(", did you mean {}?", nearest),
                                     fmt::join(names, ", ")));
    }
    std::vector<Figure> chosen;
    for (const Figure& figure : all) {
        if (ids.empty() || std::find(ids.begin(), ids.end(), figure.id) != ids.end()) chosen.push_back(figure);
    }
    return chosen;
}

}  // namespace polargrain
