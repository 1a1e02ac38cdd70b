#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/model/observable_spec.h"
#include "src/plot/plot.h"
#include "src/reproduce/figure.h"

namespace polargrain {

inline constexpr double k_bin_frame = 0.005;  ///< [s] between stored frames

/// One of the two bins.
struct Bin {
    std::string figure;  ///< "Fig. 16"
    std::string scenario;
    std::string grains;
    unsigned seeds;
    unsigned shown_seed;
    Opening opening;
    std::vector<double> snapshot_times;  ///< those printed [s]
    std::string colour;                  ///< what the fill shows
    std::string name = {};               ///< of its pieces, where the opening is not that of the scenario
    std::vector<std::string> set = {};   ///< laid over the scenario
};

const Bin& rough_bin();
/// Sticks, with an opening of 3.6 lengths, through which they flow.
const Bin& stick_bin();
/// Sticks as in the shipped scenario, whose opening is 2.4 lengths wide.
const Bin& narrow_stick_bin();

Piece bin_piece(const Bin& bin, const std::string& engine, unsigned seed);
/// All seeds with each of the engines.
std::vector<Piece> bin_pieces(const Bin& bin, const std::vector<std::string>& engines);

/// What one run of a bin shows.
struct BinRun {
    Series out;                                        ///< grains out over time
    std::vector<double> pauses;                        ///< of the flow, that ended again [s]
    std::vector<double> bridge_lives;                  ///< of arches at rest [s]
    double standing_at_end = 0.0;                      ///< 1 where a bridge stands in the last frame
    double last_out = 0.0;                             ///< [s] when the last grain left
    std::vector<double> tilt_in_opening, tilt_in_bed;  ///< of long axes, from the vertical [degrees, 0 to 90]
};

/// Reads what all seeds have left. tilts: the directions of long axes too.
std::vector<BinRun> read_bin_runs(const FigureDesk& desk, const Bin& bin, const std::string& engine, bool tilts);

}  // namespace polargrain
